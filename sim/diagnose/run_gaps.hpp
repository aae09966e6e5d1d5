// What each run measured, beside what rigs make of it; and what the runs cover.
#pragma once

#include <string>
#include <vector>

#include <plant/rig.hpp>
#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/experiment.hpp>

namespace mckibben::diagnose {

/// The rigs of a diagnosis: as described, with its numbers fitted, with what was found.
struct ThreeRigs {
  const Rig &nominal, &recalibrated, &corrected;
};

/// All runs of the experiment, also those that are not `usable`. Throws engine::NumericalFailure.
std::vector<RunGap> gaps_of_runs(const Experiment& experiment, const Runs& held_out, const Runs& usable,
                                 const ThreeRigs& rigs);

/// The ranges that the runs cover, in words.
std::string visited(const domain::Dataset& data, const Runs& runs);

}  // namespace mckibben::diagnose
