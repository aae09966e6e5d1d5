// What is drawn of two muscles on one wheel, and of one muscle that followed stamps. A quantity X that was
// measured or wanted has the keys given_X, X and X_error.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/rig_file.hpp>
#include <sim/report/contents.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::report {

inline constexpr double in_degrees = 1.0 / plant::degree_rad;

/// Refers to `rig` and `recording`. Angles in deg, pressures in bar.
std::vector<Quantity> pair_quantities(const domain::RigFile& rig, const run::Recording& recording);
std::vector<Quantity> single_quantities(const run::Recording& recording);

/// What is drawn beside a quantity, and what its error is called; nothing if empty.
struct Beside {
  std::string label{}, error{};
};
inline Beside measured_beside() {
  return {"measured", "simulated less measured"};
}
inline Beside target_beside() {
  return {"target", "angle less target"};
}

std::vector<Plot> pair_plots(const Beside& angle, bool commands);
/// What was measured of one muscle; commands drove it, or a pressure did.
struct Measured {
  bool contraction = false, force = false, pressure = false, commands = false;
};
std::vector<Plot> single_plots(const Measured& measured);

/// Of what is measured alone of a pair, as measured_plots (quantities.hpp).
std::vector<Plot> measured_pair_plots();
std::vector<Loop> measured_pair_loops();

std::vector<Loop> pair_loops();
std::vector<Loop> single_loops();

}  // namespace mckibben::report
