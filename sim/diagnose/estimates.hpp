// The numbers of the final fit with their intervals, each filed where it belongs: under an effect, the law,
// or what has moved and what absorbed what.
#pragma once

#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/fit.hpp>
#include <sim/diagnose/interval.hpp>

namespace mckibben::diagnose {

/// Files the free parameters of the final fit under effects, law and nominal parameters. `bounds`: one for
/// each free parameter; `recalibrated`: the rig fitted without effects.
void tell_parameters(Diagnosis& diagnosis, const Model& model, const std::vector<Bounds>& bounds,
                     const Rig& recalibrated);

}  // namespace mckibben::diagnose
