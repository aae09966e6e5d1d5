// The numbers of a model, as they are told; after its evidence.
#pragma once

#include <string>
#include <vector>

#include <sim/identify/model.hpp>

namespace mckibben::identify {

/// A number of what is at work, and its deviation.
struct Estimate {
  std::string name, unit;
  double value = 0.0, deviation = 0.0;
};

/// Sizes and shapes of effects and faults of the bench, in their SI units.
std::vector<Estimate> sizes_of(const Model& model);
/// Parameters of the rig, in deviations of the sheet.
std::vector<Estimate> parameters_of(const Model& model);

}  // namespace mckibben::identify
