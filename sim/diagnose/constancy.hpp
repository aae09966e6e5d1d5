// A name is earned by being constant: a real effect has the same size wherever it is measured, one that
// stands in for another has not. So the size of each effect of a fitted model is found from parts of the data
// alone, each load, each kind of current, each speed, with all that is free beside it in common.
#pragma once

#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/fit.hpp>

namespace mckibben::diagnose {

/// One for each effect of a model, in its order. Sizes are found by one step along the slopes at the fit, on
/// `runs`; errors are as those of intervals (sandwich estimator: White, Econometrica 48 (1980) 817-838), so
/// that what the model leaves counts in them. Throws engine::NumericalFailure, run::Interrupted.
std::vector<Constancy> constancies(const Experiment& experiment, const Model& fitted, const Runs& runs,
                                   double inflation);

/// By how much sizes in these parts, with this covariance [unit^2], differ for certain.
/// `size`: the effect's, of all data. Parts with an infinite variance know nothing.
Drift drift_of(std::string along, std::vector<SizeIn> sizes, const Eigen::MatrixXd& covariance, double size);

}  // namespace mckibben::diagnose
