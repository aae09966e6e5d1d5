// What is known of a rig's numbers before anything is measured: the parameters that a calibration may move,
// with what a data sheet says of them.
#pragma once

#include <vector>

#include <plant/rig.hpp>
#include <sim/diagnose/parameter.hpp>

namespace mckibben::diagnose {

/// The nominal parameters, with priors as tight as a data sheet or a ruler; those that the rig's file says
/// how well it knows, with that (also of parameters that would not move else; one that is known exactly does
/// not). Those of effects that the rig has already count with them; their size is believed to a factor of a
/// few, or to what is typical, whichever is more.
std::vector<Parameter> nominal_parameters(const Rig& nominal, const plant::Spreads& stated = {});

}  // namespace mckibben::diagnose
