// What cannot be, or hardly, in measured data, before anything is simulated: `check`, `replay` and `diagnose`
// ask it first. Each finding says the line to write.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sim/data/finding.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::data {

/// Clocks that cannot be, readings that never move, the same rows under two names, given pressures that no
/// supply has, that are absolute, or that could lift nothing, steps coarser than the sensor's.
std::vector<Finding> implausible(const domain::Dataset& data);

/// The step that a run's readings of position come in, where it is coarser than what the rig's sensor
/// resolves; 0 where it is not.
double coarse_step(const domain::Dataset& data, const domain::Run& run, const std::vector<double>& values);

/// Of a pressure's unit, in the spellings that `columns` usually has.
std::optional<double> size_Pa(std::string_view unit);

/// What one of a column's unit is in what the signal is calculated in: contraction ratio, Pa, N, rad; none
/// where that is not known here.
std::optional<double> size_in_ours(const domain::Run& run, const plant::Channel& channel,
                                   std::string_view unit);

/// What to write if the pressure that this key gives is absolute; empty if it has a zero.
std::string if_absolute(const domain::Dataset& data, std::size_t run, const std::string& key);

}  // namespace mckibben::data
