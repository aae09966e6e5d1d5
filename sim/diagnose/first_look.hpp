// Faults of the recording that show before anything of the rig has been named.
#pragma once

#include <vector>

#include <sim/diagnose/faults.hpp>
#include <sim/diagnose/trial.hpp>

namespace mckibben::diagnose {

/// Examines the runs from the rig as `described`, then from a fit to those that are not suspected; beside an
/// effect that may be missing, too. Throws engine::NumericalFailure, run::Interrupted.
std::vector<Fault> first_look(const Case& c, const Model& described, const Runs& usable, const Step& step);

}  // namespace mckibben::diagnose
