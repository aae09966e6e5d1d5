// A controller on a bench, tick by tick in the clock's time; the order of a tick is that of a simulated one
// (sim/run/simulate.hpp). However it ends, the last thing that is put out is the lowest of the DAC, 0 mA: the
// valve vents. The loop owns the output; the controller lives in another process (hosted.hpp), which vents if
// this one cannot.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <controllers/controller.hpp>
#include <controllers/current_range.hpp>
#include <plant/rig.hpp>
#include <sim/bench/device.hpp>

namespace mckibben::bench {

struct Row {
  std::int64_t tick;
  double current_mA;  ///< as the DAC gives it
  std::int64_t counts;
  double gauge_Pa;        ///< NaN if the device has no gauge
  double read_s, sent_s;  ///< when the readings were taken and the command went out, since tick 0
};

struct LoopPlan {
  plant::Rig rig;        ///< its tick, settling time, DAC and counts, and what it can do
  double load_kg = 0.0;  ///< that hangs
  std::int64_t ticks = 0;
  controllers::CurrentRange limits;  ///< of every output but the last
  int most_missed_ticks = 3;         ///< in a row
  double start_limit_s = 10.0;       ///< for the controller's first answer; the clock starts after it
  /// Of the machine's time, without a tick; then the controller's process vents.
  double longest_silence_s = std::numeric_limits<double>::infinity();
  std::function<void(const Row&)> record = [](const Row&) {};  ///< hears each row as it comes
};

struct Recorded {
  std::vector<Row> rows;  ///< from tick 0 on
  std::int64_t missed_ticks = 0, limited_ticks = 0;
  std::string stopped;   ///< why it ended before its time; empty if it did not
  bool by_user = false;  ///< as the user asked (run::interrupted)
  std::vector<controllers::Finding> findings{};
};

Recorded drive(Device& device, std::unique_ptr<controllers::Controller> controller, const LoopPlan& plan,
               Clock& clock);

}  // namespace mckibben::bench
