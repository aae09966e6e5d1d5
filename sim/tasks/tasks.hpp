// What goes with a job, whoever asks for it: data made ready for it, and what is to be said of the result.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/identify/diagnosis.hpp>
#include <sim/identify/simulator.hpp>
#include <sim/run/replay.hpp>
#include <sim/thesis/pressure_model.hpp>

namespace mckibben::tasks {

/// A data set, on another rig if `rig` is not empty, which `take` gives it. Throws input::MissingInput, and
/// input::BadInput with what is wrong with both.
domain::Dataset read_measured(const std::string& dataset, const std::string& rig,
                              void (*take)(domain::Dataset&, const std::string& called, plant::Rig));

// A replay.

/// Another rig for the data. `called`: as messages call it. Throws input::BadInput where the data are not of
/// such a rig.
void replace_rig(domain::Dataset& dataset, const std::string& called, plant::Rig rig);

/// How the data were read, and what in them can hardly be, before anything is simulated. Throws
/// data::UnfitData.
std::vector<std::string> asked_first(const domain::Dataset& dataset);

/// That, what looks wrong in the data, and what is doubtful in their simulation. Throws data::UnfitData where
/// a comparison with them would mean nothing. `judged`: whether a diagnosis takes them.
std::vector<std::string> warnings_of(const domain::Dataset& dataset,
                                     const std::vector<run::ReplayedRun>& runs, bool* judged = nullptr);

// A calibration.

/// A data set with a row each tick: what it is, or rows made of its stamps; `say` hears that, and what
/// `check` says of the data. Throws input::BadInput, data::UnfitData where it cannot be.
domain::Dataset ticked(domain::Dataset data, const thesis::Orders& orders,
                       const std::function<void(const std::string&)>& say);

// A diagnosis.

/// What a diagnosis has to repeat, and what only where it has not estimated the loads.
struct Prepared {
  std::vector<std::string> warnings{};
  std::vector<identify::LoadDoubt> of_loads{};
};

/// Adds the laws of hypothesis files to the rig, on both sides of a pair, checks that the data can be judged
/// and makes rows of stamps. `say` hears before anything is fitted what `check` and `replay` say of the data,
/// of doubtful loads only that they are estimated. Throws input::BadInput, input::MissingInput,
/// data::UnfitData.
Prepared prepare(domain::Dataset& data, const std::vector<std::string>& hypotheses,
                 const std::function<void(const std::vector<std::string>&)>& say);

struct Diagnosing {
  unsigned threads = 0;
  std::uint64_t seed = 1;
  double time_limit_s = std::numeric_limits<double>::infinity();  ///< of the search, which it only stops
  Prepared prepared{};
  const identify::Simulated* known = nullptr;  ///< of a search that was ended
};

/// What is found, and the runs replayed on the data set's rig and on
/// the corrected one, for pressures and forces.
struct Found {
  diagnose::Diagnosis diagnosis;
  std::vector<run::ReplayedRun> nominal, corrected;
  identify::Simulated simulated;  ///< of a search that was ended, to go on from
};
/// Progress counts steps and has no total. Throws run::Interrupted where the user stops it before there is
/// anything to hand over, or again after that; data::UnfitData; engine::NumericalFailure.
Found find(const domain::Dataset& data, const Diagnosing& how, const run::ProgressHook& progress);

}  // namespace mckibben::tasks
