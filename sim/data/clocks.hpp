// Clocks of recorders, before anything is simulated: runs that last next to nothing or half a day, that count
// in another unit than others, gaps in their stamps.
#pragma once

#include <string>
#include <vector>

#include <sim/data/finding.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::data {

/// What is wrong with them, and the lines to write. Where a run is too short for the rows of the slowest one,
/// nothing could be judged of it.
std::vector<Finding> wrong_clocks(const domain::Dataset& data);

/// That stamps last next to nothing, and the unit that they may be in; empty if they do not.
std::string too_short(const std::vector<double>& time_s, domain::ColumnPlace time);

}  // namespace mckibben::data
