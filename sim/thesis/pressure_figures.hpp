// Figures 4.27 to 4.49, and what all figures share.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <sim/thesis/figures.hpp>

namespace mckibben::thesis {

void add_pressure_figures(const CalibrationResult& result, bool kgf, std::vector<Figure>& all);

std::vector<double> list(const Eigen::VectorXd& values);
/// Every n-th sample, so that there are at most `most`, by contraction ratio.
Samples thinned(const Samples& samples, std::size_t most = most_dots);

}  // namespace mckibben::thesis
