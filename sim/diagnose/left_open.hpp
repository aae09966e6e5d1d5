// What the data leave open: directions in which the fitted numbers may move together without the readings
// telling it (the sloppy directions of Gutenkunst et al., PLoS Comput. Biol. 3 (2007) e189), in words of one,
// two or a few numbers.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <sim/diagnose/diagnosis.hpp>

namespace mckibben::diagnose {

/// A number of the rig as it was fitted.
struct FittedOne {
  std::string path, unit;
  double value, scale;  ///< the latter of the value; of one that counts in logarithms the value itself
};

/// Of numbers of which the data alone, without the priors, have this curvature, in their scales. A number
/// that nothing was said of counts in what is typical of it.
std::vector<LeftOpen> left_open(const Eigen::MatrixXd& information, const std::vector<FittedOne>& numbers);

}  // namespace mckibben::diagnose
