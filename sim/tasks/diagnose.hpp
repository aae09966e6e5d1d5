// What goes with a diagnosis, whoever asks for it: data made ready for it, and their replays beside it.
#pragma once

#include <string>
#include <vector>

#include <sim/diagnose/diagnose.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/run/replay.hpp>

namespace mckibben::tasks {

/// Adds the laws of hypothesis files to the rig, on both sides of a pair, checks that the data can be judged
/// and makes rows of stamps. Gives what is to be warned of. Throws input::BadInput, input::MissingInput,
/// data::UnfitData.
std::vector<std::string> prepare(domain::Dataset& data, const std::vector<std::string>& hypotheses);

/// What is found, and the runs replayed on the data set's rig and on
/// the corrected one, for pressures and forces.
struct Found {
  diagnose::Diagnosis diagnosis;
  std::vector<run::ReplayedRun> nominal, corrected;
};
Found find(const domain::Dataset& data, const diagnose::Settings& settings,
           const run::ProgressHook& progress);

}  // namespace mckibben::tasks
