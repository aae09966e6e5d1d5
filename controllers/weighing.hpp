// Weighing of an unknown load (T 4.3): the muscle contracts five times at a constant speed of the current;
// braid force less friction is the load's weight (T 4.29 to 4.31). Known are counts and currents, no more.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <controllers/calibration.hpp>
#include <controllers/current_range.hpp>

namespace mckibben::controllers {

/// The triangles of current that lift the load.
struct WeighingSettings {
  int contractions = 5;
  std::optional<double> speed_mA_per_s = std::nullopt;
  std::optional<double> low_mA = std::nullopt, high_mA = std::nullopt;

  /// What is left open becomes the thesis's share of `range`:
  /// of its 4 to 20 mA, up to 8 mA at 6 mA/s (T 4.3).
  void follow(const CurrentRange& range);

  static void fields(auto& self, auto& visit) {
    visit("contractions", self.contractions, 2, 1000, "how often the load is lifted (T 4.3: five times)");
    visit(
        "speed", self.speed_mA_per_s, "mA/s", 1e-3, 1e5,
        "speed of the command; 3/8 of the valve's span in a second if absent, within the calibrated speeds");
    visit("low", self.low_mA, "mA", 0.0, 100.0,
          "command between two contractions; the valve's zero_command if absent");
    visit("high", self.high_mA, "mA", 0.0, 100.0,
          "command at the top of each; a quarter of the valve's span up if absent");
  }
  void rules(auto& report) const {
    if (low_mA && high_mA && *high_mA <= *low_mA) report("high", "must be above low");
  }
};

struct WeighedLoad {
  double load_kg = 0.0;
  double spread_kg = 0.0;  ///< standard deviation over the contractions
};

/// One weighing, tick by tick: `current_mA` is what the DAC is to give, `see` is told what came of it.
class Weighing {
 public:
  Weighing(WeighingSettings settings, const Calibration& calibration, const Knowledge& knowledge);

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

  FrictionModel friction_;
  CalibratedRange range_;
  TubePull tube_;
  ForceModel braid_;
  ValveLine valve_;
  double contraction_per_count_, middle_of_count_, tick_s_;
  std::int64_t contractions_, ticks_each_ = 0;
  double speed_mA_per_s_ = 0.0, low_mA_ = 0.0, high_mA_ = 0.0;
  std::vector<Contraction> seen_;
};

}  // namespace mckibben::controllers
