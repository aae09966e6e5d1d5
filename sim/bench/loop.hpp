// A controller on a bench, tick by tick in the clock's time; the order of a tick is that of a simulated one
// (sim/run/simulate.hpp). However it ends, the last thing that is put out is the lowest of the DAC, 0 mA: the
// valve vents.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <controllers/controller.hpp>
#include <controllers/current_range.hpp>
#include <plant/rig.hpp>
#include <sim/bench/device.hpp>

namespace mckibben::bench {

struct LoopPlan {
  plant::Rig rig;  ///< its tick, settling time, DAC and counts
  std::int64_t ticks = 0;
  controllers::CurrentRange limits;  ///< of every output but the last
  double fastest_load_per_s = 10.0;  ///< counts that jump further are those of a broken counter
  int most_missed_ticks = 3;         ///< in a row
  std::function<bool()> stop;        ///< whether the user asked to
};

struct Row {
  std::int64_t tick;
  double current_mA;  ///< from this tick on, as the DAC gives it
  std::int64_t counts;
  double late_s;  ///< by which the tick began after its time
};

struct Recorded {
  std::vector<Row> rows;  ///< from tick 0 on
  std::int64_t missed_ticks = 0, limited_ticks = 0;
  std::string stopped;   ///< why it ended before its time; empty if it did not
  bool by_user = false;  ///< as the user asked
  std::vector<controllers::Finding> findings{};
};

Recorded drive(Device& device, controllers::Controller& controller, const LoopPlan& plan, Clock& clock);

}  // namespace mckibben::bench
