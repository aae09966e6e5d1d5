// The result of a diagnosis in words and numbers: estimates with their intervals, what has moved, what
// absorbed what, and one sentence that says it.
#pragma once

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/fit.hpp>
#include <sim/diagnose/interval.hpp>

namespace mckibben::diagnose {

/// Files the free parameters of the final fit under effects, law and nominal parameters. `bounds`: one for
/// each free parameter; `recalibrated`: the rig fitted without effects.
void tell_parameters(Diagnosis& diagnosis, const Model& model, const std::vector<Bounds>& bounds,
                     const plant::Rig& recalibrated);

/// The verdict in a sentence. Needs everything else.
std::string because(const Diagnosis& diagnosis);

}  // namespace mckibben::diagnose
