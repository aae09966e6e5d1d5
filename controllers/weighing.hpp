// Weighing of an unknown load (T 4.3): the muscle contracts five times at a constant speed of the current;
// braid force less friction is the load's weight (T 4.29 to 4.31). Known are counts and currents, no more.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <controllers/calibration.hpp>
#include <controllers/controller.hpp>

namespace mckibben::controllers {

/// The triangles of current that lift the load.
struct WeighingSettings {
  int contractions = 5;
  double speed_mA_per_s = 6.0;
  double low_mA = 4.0, high_mA = 8.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("contractions", self.contractions, 2, 1000, "how often the load is lifted (T 4.3: five times)");
    visit("speed", self.speed_mA_per_s, "mA/s", 1e-3, 1e5, "speed of the current");
    visit("low", self.low_mA, "mA", 0.0, 100.0, "current between two contractions");
    visit("high", self.high_mA, "mA", 0.0, 100.0, "current at the top of each");
  }
  template <class Report>
  void rules(Report& report) const {
    if (high_mA <= low_mA) report("high", "must be above low");
  }
};

struct WeighedLoad {
  double load_kg = 0.0;
  double spread_kg = 0.0;  ///< standard deviation over the contractions
};

/// One weighing, tick by tick: `current_mA` is what the DAC is to give, `see` is told what came of it.
class Weighing {
 public:
  Weighing(const WeighingSettings& settings, const FrictionModel& friction, const CalibratedRange& range,
           const Knowledge& knowledge);

  std::int64_t ticks() const { return contractions_ * ticks_each_; }

  /// Current at a tick counted from the beginning of the weighing.
  double current_mA(std::int64_t tick) const;

  /// The counts read at that tick, just before its current is given. In order.
  void see(std::int64_t tick, std::int64_t counts);

  /// Load and spread, once all ticks are seen. Throws ControllerFailure if the load hardly moved.
  WeighedLoad result() const;

 private:
  struct Contraction {
    double sum_kg = 0.0;
    int samples = 0;
    std::int64_t lowest_counts = 0, highest_counts = 0;
  };

  WeighingSettings settings_;
  FrictionModel friction_;
  CalibratedRange range_;
  ForceModel braid_;
  ValveLine valve_;
  double contraction_per_count_, tick_s_;
  std::int64_t contractions_, ticks_each_;
  std::vector<Contraction> seen_;
};

}  // namespace mckibben::controllers
