// Models of the friction coefficient against contraction and current speed: chi-square (T 4.4), polynomial of
// fifth order (T 4.5) and superposition (T 4.6). All loads of one speed are fitted together: the thesis's
// coefficient has no load in it.
#pragma once

#include <vector>

#include <controllers/calibration.hpp>
#include <sim/thesis/cells.hpp>
#include <sim/thesis/least_squares.hpp>

namespace mckibben::thesis {

/// The fits at one current speed.
struct FrictionAtSpeed {
  double speed_mA_per_s = 0.0;
  Samples samples;  ///< of all loads
  double mean = 0.0;
  ProjectedFit chi_square;        ///< amplitude, and degrees of freedom as its parameter
  LinearFit fifth_order;          ///< p0 ... p5
  LinearFit superposition;        ///< f0 + f1 nu^2 as one number, f2, f3
  double common_deviation = 0.0;  ///< standard deviation from the model over all speeds
};

struct FrictionFit {
  std::vector<FrictionAtSpeed> speeds;
  LinearFit common;     ///< an intercept for each speed, then f2 and f3, from all samples at once
  LinearFit linear;     ///< intercepts against nu^2: f1, f0
  LinearFit quadratic;  ///< the same with nu^4 in front; no values with fewer than three speeds
  double mean = 0.0, standard_deviation = 0.0;  ///< of the coefficient, of its distance from the model

  double spread() const { return standard_deviation / mean; }
  Estimate f0, f1, f2, f3;  ///< f0 and f1 with the intercepts' own errors in theirs
  controllers::FrictionModel model() const;
};

/// `order` of the intercept in nu^2, 0 or 1.
FrictionFit fit_friction(const Grid& grid, Direction direction, int order);

/// T 4.4 with an amplitude of one.
Eigen::VectorXd chi_square(const Eigen::VectorXd& contraction_ratio, double degrees_of_freedom);
/// T 4.5, p0 first.
Eigen::VectorXd fifth_order(const Eigen::VectorXd& contraction_ratio, const Eigen::VectorXd& p);

}  // namespace mckibben::thesis
