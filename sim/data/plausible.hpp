// What cannot be, or hardly, in measured data, before anything is simulated: `check`, `replay` and `diagnose`
// ask it first. Each finding says the line to write.
#pragma once

#include <vector>

#include <sim/data/finding.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::data {

/// Runs that last next to nothing or half a day, gaps in stamps, readings that never move, the same rows
/// under two names, given pressures that no supply has, that are absolute, or that could lift nothing, steps
/// coarser than the sensor's.
std::vector<Finding> implausible(const domain::Dataset& data);

}  // namespace mckibben::data
