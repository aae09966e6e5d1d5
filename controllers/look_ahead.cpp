// One root by secants; see the header.
#include <algorithm>
#include <cmath>
#include <sstream>

#include <controllers/look_ahead.hpp>

namespace mckibben::controllers {
namespace {

constexpr double close_enough = 2e-5;  // contraction ratio: a twentieth of the thesis's count
constexpr double suspicious_rmse = 0.005;
constexpr int most_trials = 4;
constexpr double largest_step = 1.0 / 16.0;  // between two trials, of all currents
constexpr double least_slope = 0.016;        // contraction ratio over all currents: a load that sticks

}  // namespace

LookAhead::LookAhead(double width_mA, int ticks)
    : ticks_(ticks), largest_step_mA_(largest_step * width_mA), least_slope_per_mA_(least_slope / width_mA) {}

double LookAhead::reached(RigModel& model, double current_mA) const {
  model.go_back();
  model.step({current_mA}, 1);  // the current changes within its first tick alone
  if (ticks_ > 1) model.step({current_mA}, ticks_ - 1);
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

void require_long_enough(int ticks, double tick_s, double rmse,
                         const std::function<double(int ticks)>& rmse_with) {
  if (rmse < suspicious_rmse) return;
  // Of one that is far too short, twice is too short as well.
  const int longer = std::max(2 * ticks, PlansWithModel{}.look_ahead_ticks(tick_s));
  const double better = rmse_with(longer);
  if (better > 0.5 * rmse) return;
  std::ostringstream text;
  text << "look_ahead, " << 1e3 * ticks * tick_s
       << " ms, is shorter than this rig takes to answer: on its own "
       << "model the plan errs by a contraction ratio of " << rmse << " (rmse), with "
       << 1e3 * longer * tick_s << " ms by " << better;
  throw ControllerFailure(text.str());
}

}  // namespace mckibben::controllers
