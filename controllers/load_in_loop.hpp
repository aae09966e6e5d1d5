// The load, as a closed loop shows it: what must hang there if the calibrated model asks for the current that
// the loop gives. Ours; the thesis lifts the load five times before it begins (T 4.3).
#pragma once

#include <cstdint>
#include <optional>

#include <controllers/calibration.hpp>
#include <controllers/controller.hpp>
#include <controllers/inverse.hpp>

namespace mckibben::controllers {

/// Current [mA] half way between the two branches at the slowest calibrated speed: at which the load would
/// rest if its threads pulled neither way. Beyond the calibrated contraction ratios that of the range's end.
double balanced_mA(const Inverse& inverse, const ValveLine& valve, double contraction_ratio);

/// Sees the target go through stretches, in each of which it rests, rises or falls.
class LoadInLoop {
 public:
  LoadInLoop(const Calibration& model, const Knowledge& knowledge) : model_(model), knowledge_(knowledge) {}

  /// The counts of a tick and the current that the loop gave the tick before; `free` unless that was at a
  /// limit. In order, from tick 0 on.
  void see(std::int64_t tick, std::int64_t counts, double current_mA, bool free);

  /// The mean over the stretches that are over; none before one was long enough [kg].
  std::optional<double> load_kg() const;

 private:
  struct Sum {
    double kg = 0.0;
    std::int64_t times = 0;
  };
  double explained_kg(double ratio, double speed_per_s, double current_mA) const;

  Calibration model_;
  Knowledge knowledge_;
  int direction_ = 0;
  std::int64_t ticks_ = 0;  // since the target last turned, started or stopped
  Sum stretch_, all_;
};

}  // namespace mckibben::controllers
