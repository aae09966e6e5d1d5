// The current that brings a model to its target a few ticks ahead: tried on the model itself, which is kept
// and taken back, so that whatever the model knows (friction and its memory, valve, hose, effects) is
// inverted.
#pragma once

#include <functional>

#include <controllers/current_range.hpp>
#include <controllers/rig_model.hpp>

namespace mckibben::controllers {

/// At each tick a current that, held for some ticks, ends on the target (predictive functional control,
/// Richalet & O'Donovan 2009, with one base function and one point of coincidence). One root by secants.
class LookAhead {
 public:
  /// `width_mA`: of all currents that there are.
  LookAhead(double width_mA, int ticks);

  /// Current [mA] for the tick at which `model` is; it is the same afterwards. `target`: contraction ratio
  /// wanted `ticks` further. `before_mA`: current of the tick before, within `limits`.
  double current_mA(RigModel& model, double target, double before_mA, const CurrentRange& limits);

 private:
  double reached(RigModel& model, double current_mA) const;

  int ticks_;
  double largest_step_mA_, least_slope_per_mA_;
  double slope_per_mA_ = 0.0;  // of what is reached over the current; as last found
};

/// Throws ControllerFailure if a plan follows its target badly only because it looks ahead by less than the
/// rig takes to answer: looking twice as far, and as far as usual, halves its error. A target out of reach
/// does not. `rmse_with`: error of a plan that looks ahead by so many ticks.
void require_long_enough(int ticks, double tick_s, double rmse,
                         const std::function<double(int ticks)>& rmse_with);

}  // namespace mckibben::controllers
