// Columns that are each other's, as readings and the rig's ranges say; run::exchanged_columns simulates more.
#pragma once

#include <vector>

#include <sim/data/examine.hpp>

namespace mckibben::data {

/// Current and pressure of a rig with a row each tick; readings of two muscles.
std::vector<Finding> exchanged(const domain::Dataset& data, const std::vector<Expected>& expected);

}  // namespace mckibben::data
