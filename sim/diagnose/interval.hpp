// How well the data determine what was fitted: 95 % intervals that hold for residuals that are neither white
// nor normal (sandwich estimator with segments as clusters: White, Econometrica 48 (1980) 817-838), nor
// without error where a reading stands still on a count (what counting does to the fit, by simulation:
// parametric bootstrap, Efron & Tibshirani, An Introduction to the Bootstrap, 1993).
#pragma once

#include <array>
#include <optional>

#include <sim/diagnose/fit.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {

/// What a sandwich is made of: the scores of all segments times their transpose, and how many there are.
struct Scatter {
  Eigen::MatrixXd scores;
  Eigen::Index segments;
};
Scatter scatter_of(const Experiment& experiment, const Runs& runs, const Eigen::MatrixXd& columns,
                   const Eigen::VectorXd& residuals, double inflation);

struct Bounds {
  double value, low, high;
  bool determined;                ///< less than all that is allowed, or than a whole turn of an angle
  double half = 0.0, rise = 0.0;  ///< half of it in the parameter's scale, and of the cost up to there
  std::optional<std::array<double, 2>> quadratic{};  ///< what low and high were before a profile was taken
};

/// One for each free parameter of a model fitted to `runs`, so many standard errors each way.
std::vector<Bounds> intervals(const Experiment& experiment, const Fitted& fitted, const Runs& runs,
                              double inflation, double deviations = thresholds.interval.normal);

}  // namespace mckibben::diagnose
