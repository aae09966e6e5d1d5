// Columns against what the rig would do: another unit than they say, the other sign, exchanged.
#pragma once

#include <vector>

#include <sim/run/sanity.hpp>

namespace mckibben::run {

/// Adds to `objections`: one for each kind, with all runs that it concerns.
void check_columns(const domain::Dataset& data, const std::vector<Expected>& expected,
                   std::vector<domain::Objection>& objections);

}  // namespace mckibben::run
