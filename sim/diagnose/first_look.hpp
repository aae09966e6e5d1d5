// Faults of the recording that show before anything of the rig has been named.
#pragma once

#include <vector>

#include <sim/diagnose/check.hpp>
#include <sim/diagnose/faults.hpp>
#include <sim/diagnose/trial.hpp>

namespace mckibben::diagnose {

/// Whether `faults` leave less to be explained than `others`; neither is empty. A run of another rig leaves
/// most, and a fault that all runs have is one.
bool explains_more(const std::vector<Fault>& faults, const std::vector<Fault>& others);

/// Examines the runs from the rig as `described`, then from a fit to those that are not suspected, and takes
/// the list that explains more; beside an effect that may be missing, too. Throws engine::NumericalFailure,
/// run::Interrupted.
std::vector<Fault> first_look(const Case& c, const Checked& checked, const Model& described,
                              const Runs& usable, const Step& step);

}  // namespace mckibben::diagnose
