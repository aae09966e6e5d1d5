// Step sizes for ERKStep, by a PI rule (Gustafsson, ACM TOMS 17 (1991) 533-554), such that a tick is divided
// evenly: a last step cut short in every tick would make the first of the next one start small again.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include <sundials/sundials_nvector.h>

namespace mckibben::engine {

struct PiRule {
  float log_of_last_error = 0.0F;

  /// The step to take after one of size h that had this local error (1 = tolerance): a whole part of what is
  /// then left of the tick, or at its end of the next one.
  double next(double h, double error, double left_s, double tick_s) {
    const float now = std::log(static_cast<float>(std::max(error, 1e-10)));  // exact enough for a step size
    const bool accepted = error <= 1.0;
    const float change = std::exp(accepted ? -0.16F * now + 0.05F * log_of_last_error : -0.2F * now);
    const double wanted = 0.9 * h * static_cast<double>(change);
    if (accepted) log_of_last_error = now;
    const double span_s = left_s > nothing * tick_s ? left_s : tick_s;
    return span_s / std::ceil(span_s / wanted);
  }

  static constexpr double nothing = 1e-9;  ///< of a tick: it is over
};

/// The same for ERKStep, whose steps are those of one series.
class EvenSteps : public PiRule {
 public:
  void begin(double from_s, double to_s) {
    tick_s_ = to_s - from_s;
    stop_s_ = to_s;
    resumed_step_s.reset();
  }

  /// The callback: called with the local error of a step of size h that ends, or if rejected begins, at t.
  static int choose(N_Vector, double t, double h, double, double, double error, double, double, int, int,
                    double* step, void* self) {
    auto& steps = *static_cast<EvenSteps*>(self);
    if (error <= 1.0) steps.reached_s = t;
    *step = steps.next(h, error, steps.stop_s_ - t, steps.tick_s_);
    return 0;
  }

  double reached_s = 0.0;                  ///< end of the last accepted step
  std::optional<double> resumed_step_s{};  ///< the step that was resumed at, until one is made

 private:
  double stop_s_ = 0.0, tick_s_ = 0.0;
};

}  // namespace mckibben::engine
