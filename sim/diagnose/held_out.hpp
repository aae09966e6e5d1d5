// Which runs a fit may see, how its residuals scatter over long times, and whether one model is better than
// another on runs that neither has seen.
#pragma once

#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {

/// What runs are told apart by: their load [kg], or on a bench the contraction ratio that they were held at.
double level_of(const domain::Run& run);

/// Rows of a run that residuals remember: a segment, which counts as one.
Eigen::Index segment_rows(const Experiment& experiment);

struct Split {
  Runs training, held_out;
};

/// Holds out whole loads from inside the range, with the kinds of current that come with them: about a third
/// of the runs, never the outermost loads. With too few loads, the last third of the runs. `usable`: not left
/// out.
Split split(const domain::Dataset& data, const Runs& usable);

/// So many of the runs, spread evenly over loads and, in their order, currents; all if there are no more.
Runs a_few(const domain::Dataset& data, const Runs& runs, std::size_t most);

/// As many as a search asks, in the same way.
Runs asked(const domain::Dataset& data, const Runs& runs);
/// The same of what is fitted to, and half as many held out.
Split asked(const domain::Dataset& data, const Split& whole);

/// Variance of the residuals over long times (Bartlett's window), at least 1: by this factor the data
/// say less than as much white noise would.
double variance_inflation(const Experiment& experiment, const Eigen::VectorXd& residuals, const Runs& runs);

/// Mean square of residuals above that of the floor.
double excess(const Eigen::VectorXd& residuals);

/// Whether residuals are no more than noise and slow disturbances leave.
bool near_floor(const Eigen::VectorXd& residuals);

/// Whether those of each run are.
bool all_near_floor(const Experiment& experiment, const Eigen::VectorXd& residuals, const Runs& runs);

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
bool convinces(const Improvement& improvement, const ImprovementThresholds& least = thresholds.improvement);

}  // namespace mckibben::diagnose
