// One root by secants; see the header.
#include <algorithm>
#include <cmath>

#include <controllers/look_ahead.hpp>

namespace mckibben::controllers {
namespace {

constexpr double close_enough = 2e-5;  // contraction ratio: a twentieth of the thesis's count
constexpr int most_trials = 4;
constexpr double largest_step = 1.0 / 16.0;  // between two trials, of all currents
constexpr double least_slope = 0.016;        // contraction ratio over all currents: a load that sticks

}  // namespace

LookAhead::LookAhead(double width_mA, int ticks)
    : ticks_(ticks), largest_step_mA_(largest_step * width_mA), least_slope_per_mA_(least_slope / width_mA) {}

double LookAhead::reached(RigModel& model, double current_mA) const {
  model.go_back();
  for (int i = 0; i < ticks_; ++i) model.step({current_mA});
  return model.contraction_ratio();
}

double LookAhead::current_mA(RigModel& model, double target, double before_mA, const CurrentRange& limits) {
  model.keep();
  double u_mA = before_mA, error = reached(model, u_mA) - target;
  double best_mA = u_mA, least = std::abs(error);
  slope_per_mA_ = std::max(slope_per_mA_, least_slope_per_mA_);
  for (int trial = 1; trial < most_trials && least > close_enough; ++trial) {
    const double step_mA = std::clamp(-error / slope_per_mA_, -largest_step_mA_, largest_step_mA_);
    const double next_mA = std::clamp(u_mA + step_mA, limits.lowest_mA, limits.highest_mA);
    if (next_mA == u_mA) break;
    const double next_error = reached(model, next_mA) - target;
    slope_per_mA_ = std::max((next_error - error) / (next_mA - u_mA), least_slope_per_mA_);
    u_mA = next_mA;
    error = next_error;
    if (std::abs(error) < least) {
      least = std::abs(error);
      best_mA = u_mA;
    }
  }
  model.go_back();
  return best_mA;
}

}  // namespace mckibben::controllers
