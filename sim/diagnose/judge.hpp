// Which runs a fit may see, how its residuals scatter over long times, and whether one model is better than
// another on runs that neither has seen.
#pragma once

#include <sim/diagnose/experiment.hpp>

namespace mckibben::diagnose {

struct Split {
  Runs training, held_out;
};

/// Holds out whole loads from inside the range, with the kinds of current that come with them: about a third
/// of the runs, never the outermost loads. With too few loads, the last third of the runs. `usable`: not left
/// out.
Split split(const domain::Dataset& data, const Runs& usable);

/// Variance of the residuals over long times (Bartlett's window, 1.5 s), at least 1: by this factor the data
/// say less than as much white noise would.
double temperature(const Experiment& experiment, const Eigen::VectorXd& residuals, const Runs& runs);

/// What is assumed of it until a model has been fitted: priors count against it.
inline constexpr double first_temperature = 20.0;

/// Mean square of residuals above that of the floor.
double excess(const Eigen::VectorXd& residuals);

/// Residuals are judged by segments of this length, which scatter by themselves.
inline constexpr double segment_s = 1.5;

/// How much better `after` is than `before`, on the same runs.
struct Improvement {
  double gained = 0.0;               ///< mean square, in units of the floor's
  double share = 0.0;                ///< of the excess that `before` had
  double significance = 0.0;         ///< over its standard error, from segments
  std::size_t better = 0, runs = 0;  ///< runs it improves
};
Improvement compare(const Experiment& experiment, const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                    const Runs& runs);

/// Whether an improvement is worth a change of the model.
bool convinces(const Improvement& improvement);

}  // namespace mckibben::diagnose
