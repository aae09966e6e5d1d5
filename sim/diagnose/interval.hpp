// How well the data determine what was fitted: 95 % intervals that hold for residuals that are neither white
// nor normal (sandwich estimator with segments as clusters: White, Econometrica 48 (1980) 817-838).
#pragma once

#include <sim/diagnose/fit.hpp>

namespace mckibben::diagnose {

struct Bounds {
  double value, low, high;
};

/// One for each free parameter of a model fitted to `runs`.
std::vector<Bounds> intervals(const Experiment& experiment, const Fitted& fitted, const Runs& runs,
                              double temperature);

}  // namespace mckibben::diagnose
