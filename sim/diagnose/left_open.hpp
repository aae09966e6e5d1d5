// What the data leave open: directions in which the fitted numbers may move together without the readings
// telling it (the sloppy directions of Gutenkunst et al., PLoS Comput. Biol. 3 (2007) e189), in words of one,
// two or a few numbers.
#pragma once

#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/fit.hpp>

namespace mckibben::diagnose {

/// Of the free parameters of a fit, by the curvature that its residuals alone have, without the priors. A
/// number that nothing was said of counts in what is typical of it.
std::vector<LeftOpen> left_open(const Fitted& fitted, double inflation);

}  // namespace mckibben::diagnose
