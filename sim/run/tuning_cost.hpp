// What tuning makes small, whatever is tuned: the error of following, and a little of the current's unrest.
#pragma once

#include <sim/run/recording.hpp>

namespace mckibben::run {

/// Gains must also do with the proportional gain this much higher, so that they are not tuned to the edge of
/// stability: the loop's own gain changes with load and contraction.
inline constexpr double gain_margin = 2.0;

/// [contraction ratio], for a run whose error is `rmse`; `span_mA`: of the controller's currents. Of a pair
/// the current to muscle 1 tells of both.
double tuning_cost(double rmse, const Recording& recording, double span_mA);

}  // namespace mckibben::run
