// Thresholds of stage 2, baseline: which runs are held out and which asked, fits, their intervals, and what
// they leave open.
#pragma once

#include <cstddef>

namespace mckibben::diagnose {

struct HeldOutThresholds {
  std::size_t least_loads = 3;  ///< to hold one out from inside their range
  double enough = 1.0 / 3.0;    ///< of the runs are held out,
  double most = 0.4;            ///< no more than these by a further load,
  double most_of_all = 0.5;     ///< and no more than these at all
  double last = 1.0 / 3.0;      ///< of the runs, where loads do not do
};

/// Which of many runs a search asks: what it chooses is fitted to all.
struct AskedThresholds {
  std::size_t least_runs = 9;
  double enough_s = 288.0;  ///< as many runs as make up this. As in 24 of 12 s
  double confirmed = 1.5;   ///< of what is left of runs that were asked [mean square]: the others, at most
};

/// Least squares.
struct FitThresholds {
  int rounds = 5, thorough_rounds = 20;  ///< of descents, each along slopes of its own
  int iterations = 8;                    ///< in a round
  double falls = 0.1;  ///< of the cost, by the last of the rounds: it goes on, up to the thorough ones
  double least_descent = 0.01;  ///< of the cost, where 1 is a parameter moved by its deviation: else the last
  double coarseness = 0.01;     ///< of the cost: that is enough too, what is missing moves parameters further
  int axes_rounds = 6;          ///< steps of a thorough fit along the axes of its valley, each worth
  double worth_axes = 1.0;      ///< so much of the cost, promised, and halved
  double least_share = 0.1;     ///< down to this until it comes true
  double along_axes = 2.0;      ///< standard errors, for slopes,
  double most_along_axes = 0.2;  ///< and no more than these scales
  double hopeless =
      0.85;  ///< of what is missing to an aim: fits whose straight lines miss more are not begun
  double least_influence = 1e-12;  ///< sum of squares of a slope [floors per scale], that is rounding below
  double wider_steps = 2.0;        ///< times as wide, to both sides: slopes of numbers that are told
  double cost_tolerance = 1e-4, thorough_cost_tolerance = 1e-7;            ///< relative: a round has arrived
  double parameter_tolerance = 1e-5, thorough_parameter_tolerance = 1e-7;  ///< relative
};

/// Where a fit begins, besides the rig as described.
struct StartsThresholds {
  double wide = 0.4;                 ///< relative deviation of a number from which its range is looked over
  double reach = 2.0;                ///< deviations, each way
  std::size_t places = 14;           ///< that are looked at: two groups with the rig itself,
  std::size_t runs = 3;              ///< in so many runs,
  std::size_t begun = 2;             ///< and so many begun from
  double far = 4.0;                  ///< deviations, of one number that may be far off
  double likeness_of_arrived = 0.9;  ///< cosine, to what meets the data: begun from its numbers
  double same_cost = 0.1;            ///< of the cost: ends that differ by no more agree
};

/// Intervals.
struct IntervalThresholds {
  double normal = 1.96;   ///< deviations of a normal variable: 95 %. Convention
  double certain = 2.58;  ///< the same: 99 %. By so much what is kept differs from nothing
  int draws = 100;        ///< of what counting does
  double still = 1e-12;   ///< counts^2: what is moved less is at rest
  /// Of the rise of the cost up to quadratic ends: where it differs by more, in the mean of both or in half
  /// their difference, the profile is looked along,
  double trusted = 0.3;
  double tolerance = 0.1;  ///< until it has risen as much but for this: the end is right to 5 %,
  int rounds = 10;         ///< or so often, each
  double stride = 2.0;     ///< times as far at most
};

/// What the data leave open. Information is in units of a prior's: of 1 they say as much as was known.
struct LeftOpenThresholds {
  double says_nothing = 0.25;  ///< less: what was known is narrowed by a tenth at most
  std::size_t few = 3;         ///< numbers that are looked at together before all are
  double takes_part = 0.1;     ///< of the largest part: a number of less has none in a direction
  double equal = 0.1;          ///< relative: weights are the same
};

}  // namespace mckibben::diagnose
