// Runs that are to begin at rest, and do not.
#pragma once

#include <optional>
#include <vector>

#include <sim/data/examine.hpp>

namespace mckibben::data {

/// Runs whose readings move from the first row on, where the rig as described is still at rest: rows before
/// were cut off.
std::optional<Finding> begins_moving(const domain::Dataset& data, const std::vector<Expected>& expected);

}  // namespace mckibben::data
