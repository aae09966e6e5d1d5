// Columns and loads against what the rig would do: in another unit than they say, with the other sign,
// exchanged.
#pragma once

#include <vector>

#include <sim/data/examine.hpp>

namespace mckibben::data {

/// Adds to `findings`: one for each kind, with all runs that it concerns.
void check_columns(const domain::Dataset& data, const std::vector<Expected>& expected,
                   std::vector<Finding>& findings);

/// Gauges that read more than their supply has. Adds to `findings`, first.
void check_supply(const domain::Dataset& data, const std::vector<Expected>& expected,
                  std::vector<Finding>& findings);

/// All loads in another unit; a label that is wrong; labels that runs have of each other. Adds to `findings`.
void check_loads(const domain::Dataset& data, const std::vector<Expected>& expected,
                 std::vector<Finding>& findings);

}  // namespace mckibben::data
