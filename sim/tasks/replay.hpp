// What goes with a replay, whoever asks for it: another rig for the data, and what is to be said of the
// result.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/run/replay.hpp>

namespace mckibben::tasks {

/// `called`: as messages call the rig. Throws input::BadInput where the data are not of such a rig.
void replace_rig(domain::Dataset& dataset, const std::string& called, plant::Rig rig);

/// What looks wrong in the data, and what is doubtful in their simulation. Throws data::UnfitData where a
/// comparison with them would mean nothing.
std::vector<std::string> warnings_of(const domain::Dataset& dataset,
                                     const std::vector<run::ReplayedRun>& runs);

}  // namespace mckibben::tasks
