// All of one direction's pressure coefficients from all samples at once (ours): the thesis's equations are
// linear in everything but the exponent's line in load, so only that line is searched.
#pragma once

#include <vector>

#include <sim/thesis/cells.hpp>
#include <sim/thesis/least_squares.hpp>
#include <sim/thesis/pressure_model.hpp>

namespace mckibben::thesis {

struct JointFit {
  PressureModel model;
  std::vector<std::vector<Estimate>> estimates;  ///< of each curve's coefficients
};

JointFit fit_jointly(const Shape& shape, const std::vector<Cell>& cells);

}  // namespace mckibben::thesis
