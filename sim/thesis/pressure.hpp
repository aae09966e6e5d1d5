// Fits of the pressure models (T 4.7 to 4.28) in the thesis's order: each load and speed by itself; what does
// not follow the speed averaged and fixed, the rest fitted again; that as polynomials in speed; all of it as
// polynomials in load. Beside it the same equations fitted to all samples at once (ours; joint.cpp).
#pragma once

#include <vector>

#include <sim/thesis/cells.hpp>
#include <sim/thesis/least_squares.hpp>
#include <sim/thesis/pressure_model.hpp>

namespace mckibben::thesis {

/// Standard deviations of the pressure from the model, stage by stage [Pa].
struct Stages {
  double own = 0.0;            ///< five coefficients for each load and speed (T 4.7)
  double fixed_at_once = 0.0;  ///< all steady coefficients averaged at once
  double fixed = 0.0;          ///< exponent averaged first, the others after refitting with it
  double in_speed = 0.0;       ///< the rest as polynomials in speed (T 4.8 to 4.13)
  double in_load = 0.0;        ///< all as polynomials in load (T 4.14 to 4.28)
  double joint = 0.0;          ///< the same equations, all samples at once
};

struct PressureCell {
  double load_kg = 0.0, speed_mA_per_s = 0.0;
  double mean_Pa = 0.0;
  ProjectedFit own;
  Eigen::Vector4d refitted;  ///< c0, c1, c2, c4 with the steady ones fixed
  Stages deviation;
};

struct PressureFit {
  Shape shape;
  std::vector<PressureCell> cells;                     ///< as the grid's
  std::vector<Eigen::VectorXd> at_load;                ///< of each curve, its value at each load
  std::vector<std::vector<Estimate>> speed_estimates;  ///< of each curve at each load: the fit in speed
  std::vector<LinearFit> in_load;                      ///< of each curve, its polynomial in load
  PressureModel sequence, joint;
  std::vector<std::vector<Estimate>> joint_estimates;  ///< of each curve's coefficients
  double mean_Pa = 0.0;
  Stages deviation;  ///< over all samples
};

PressureFit fit_pressure(const Grid& grid, Direction direction, const Orders& orders);

/// Where exponents are searched.
inline constexpr double lowest_exponent = 1.0, highest_exponent = 200.0;

/// All of one direction's coefficients from all samples at once (ours): the thesis's equations are linear in
/// everything but the exponent's line in load, so only that line is searched.
struct JointFit {
  PressureModel model;
  std::vector<std::vector<Estimate>> estimates;  ///< of each curve's coefficients
};

JointFit fit_jointly(const Shape& shape, const std::vector<Cell>& cells);

}  // namespace mckibben::thesis
