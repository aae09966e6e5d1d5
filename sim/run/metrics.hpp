// How well a target was followed: errors, lag, overshoot and settling of one run, and how far one
// controller's figure spreads over the loads. Errors are e - target,
// in contraction ratio, from true (not counted) values.
#pragma once

#include <optional>
#include <span>

#include <controllers/current_range.hpp>

namespace mckibben::run {

/// One run, tick by tick from time 0.
struct Followed {
  std::span<const double> target;       ///< contraction ratio wanted
  std::span<const double> contraction;  ///< contraction ratio reached
  std::span<const double> current_mA;
  double tick_s = 0.0;
  std::optional<double> last_change_s = std::nullopt;  ///< from here settling counts; none if periodic
  double air_kg = 0.0;                                 ///< drawn from the supply
  /// Ends of the controller's current, as the DAC gives them; none if it has no limits.
  std::optional<controllers::CurrentRange> limits = std::nullopt;
};

struct Metrics {
  double rmse = 0.0;           ///< root mean square error
  double mae = 0.0;            ///< mean absolute error
  double largest_error = 0.0;  ///< largest absolute error
  double final_error = 0.0;    ///< error at the last tick, with its sign
  std::optional<double> time_lag_s;
  std::optional<double> overshoot;
  std::optional<double> settling_time_s;
  double current_travel_mA = 0.0;  ///< sum of all changes of current: the controller's effort
  double air_kg = 0.0;
  /// Shares of the ticks at which the current is at an end of its limits; none without limits.
  std::optional<double> at_lowest_current, at_highest_current;
  /// Whether it comes back to an end, from a quarter of the range away, more than once a second.
  bool swings = false;
};

/// All metrics of a run. Throws std::invalid_argument if it is empty, its columns differ in length, or its
/// tick is not above zero.
Metrics measure(const Followed& run);

/// The shift, up to 2 s or a quarter of the run, by which the delayed target fits best (least root mean
/// square), refined between ticks by a parabola. Before time 0 the target counts as held. None if the target
/// does not move or only in steps, which ask for settling, if less than a fifth of its motion (mean square)
/// is followed, or if the best shift is the largest.
std::optional<double> time_lag_s(const Followed& run);

// A motion of the target is what lies between two rests: a step, a ramp, a whole sine.

/// Whether each motion is a step, done in one tick; false if there is none.
bool moves_in_steps(std::span<const double> target);

/// Largest excursion past a motion's range before the next begins, as share of that range: above it once the
/// target has moved up in it, below it once it has moved down. Of several motions the largest share. None for
/// a constant target.
std::optional<double> overshoot(const Followed& run);

/// Time from the end of a motion until the error stays within 2 % of its range, before the next begins. Of
/// several motions the longest. None if it does not after one of them, if the target is periodic or constant.
std::optional<double> settling_time_s(const Followed& run);

/// One figure of a controller over several loads.
struct Spread {
  double lowest = 0.0, highest = 0.0;
  double mean = 0.0;
  double standard_deviation = 0.0;  ///< of the sample, n - 1; 0 for a single value

  double width() const { return highest - lowest; }
};

/// Throws std::invalid_argument if there are no values.
Spread spread(std::span<const double> values);

}  // namespace mckibben::run
