// Whether runs began settled, as the simulation takes it: a rig that is still moving or filling at the first
// reading disagrees with every model of it, for as long as that lasts.
#pragma once

#include <string>

#include <plant/rig.hpp>
#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/experiment.hpp>

namespace mckibben::diagnose {

/// What is left with the corrected rig in the first seconds of these runs, and which of them move from the
/// first reading on by more than it would. Throws engine::NumericalFailure.
Start look_at_start(const Experiment& experiment, const Rig& corrected, const Runs& runs);

/// It in a sentence, next to what the data set has `said`; empty if there is nothing to suspect, or nothing
/// left to explain.
std::string sentence_of(const Start& start, const Gap& gap, domain::Start said);

}  // namespace mckibben::diagnose
