// What is drawn of a ride that followed stamps, by two muscles on one wheel or by one muscle. A reading X
// that was measured has the keys given_X, X and X_error.
#pragma once

#include <vector>

#include <sim/domain/rig_file.hpp>
#include <sim/report/contents.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::report {

inline constexpr double in_degrees = 1.0 / plant::degree_rad;

/// Refers to `rig` and `recording`. Angles in deg, pressures in bar.
std::vector<Quantity> pair_quantities(const domain::RigFile& rig, const run::Recording& recording);
std::vector<Quantity> single_quantities(const run::Recording& recording);

std::vector<Plot> pair_plots(bool angle_is_measured, bool commands);
std::vector<Plot> single_plots(bool contraction_is_measured, bool force, bool commands);

std::vector<Loop> pair_loops();
std::vector<Loop> single_loops();

}  // namespace mckibben::report
