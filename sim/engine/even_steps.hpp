// Step sizes for ERKStep, by a PI rule (Gustafsson, ACM TOMS 17 (1991) 533-554), such that a tick is divided
// evenly: a last step cut short in every tick would make the first of the next one start small again.
#pragma once

#include <algorithm>
#include <cmath>

#include <sundials/sundials_nvector.h>

namespace mckibben::engine {

class EvenSteps {
 public:
  void begin(double from_s, double to_s) {
    tick_s_ = to_s - from_s;
    stop_s_ = to_s;
  }

  /// The callback: called with the local error (1 = tolerance) of a step of size h that ends, or if rejected
  /// begins, at t.
  static int choose(N_Vector, double t, double h, double, double, double error, double, double, int, int,
                    double* next, void* self) {
    auto& steps = *static_cast<EvenSteps*>(self);
    const float now = std::log(static_cast<float>(std::max(error, 1e-10)));  // exact enough for a step size
    const bool accepted = error <= 1.0;
    const float change = std::exp(accepted ? -0.16F * now + 0.05F * steps.log_of_last_error : -0.2F * now);
    const double wanted = 0.9 * h * static_cast<double>(change);
    if (accepted) {
      steps.log_of_last_error = now;
      steps.reached_s = t;
    }
    const double left_s = steps.stop_s_ - t;
    const double span_s =
        left_s > 1e-9 * steps.tick_s_ ? left_s : steps.tick_s_;  // at the end: plan the next tick
    *next = span_s / std::ceil(span_s / wanted);
    return 0;
  }

  double reached_s = 0.0;  ///< end of the last accepted step
  float log_of_last_error = 0.0F;

 private:
  double stop_s_ = 0.0, tick_s_ = 0.0;
};

}  // namespace mckibben::engine
