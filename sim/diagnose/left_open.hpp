// What the data leave open: directions in which the fitted numbers may move together without the readings
// telling it (the sloppy directions of Gutenkunst et al., PLoS Comput. Biol. 3 (2007) e189), in words of one,
// two or a few numbers.
#pragma once

#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/fit.hpp>

namespace mckibben::diagnose {

/// A number of the rig as it was fitted.
struct FittedOne {
  std::string path, unit;
  double value, scale;  ///< the latter of the value; of one that counts in logarithms the value itself
};

/// Of numbers of which the data alone have this curvature, in their scales.
std::vector<LeftOpen> left_open(const Eigen::MatrixXd& information, const std::vector<FittedOne>& numbers);

/// Of the free parameters of a fit, by the curvature that its residuals alone have, without the priors. A
/// number that nothing was said of counts in what is typical of it.
std::vector<LeftOpen> left_open(const Fitted& fitted, double inflation);

}  // namespace mckibben::diagnose
