// Loads weighed by the muscle: at equal pressure a heavier one contracts less. Static and quick: the braid
// force at what was measured, with the pressure that the rig would have, less the same of the simulation.
#pragma once

#include <vector>

#include <sim/data/examine.hpp>

namespace mckibben::data {

/// All loads in another unit; labels that two or more runs have of each other. Adds to `findings`.
void check_loads(const domain::Dataset& data, const std::vector<Expected>& expected,
                 std::vector<Finding>& findings);

}  // namespace mckibben::data
