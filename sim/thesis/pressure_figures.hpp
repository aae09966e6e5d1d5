// Figures 4.27 to 4.49, and what all figures share.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <sim/thesis/figures.hpp>

namespace mckibben::thesis {

void add_pressure_figures(const CalibrationResult& result, bool kgf, std::vector<Figure>& all);

// Names of columns.
inline constexpr const char* ratio_column = "contraction_ratio";
inline constexpr const char* speed_column = "current_speed_mA_per_s";

std::vector<double> list(const Eigen::VectorXd& values);
/// Every n-th sample, so that there are at most `most`, by contraction ratio.
Samples thinned(const Samples& samples, std::size_t most = most_dots);

}  // namespace mckibben::thesis
