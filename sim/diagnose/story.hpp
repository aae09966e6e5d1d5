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

/// What is wrong with the recording, each run by name, and what all have in common once; empty, or sentences
/// and a space.
std::string faults_in_words(const Diagnosis& diagnosis);

/// The faults, then the verdict in a sentence. Needs everything else.
std::string because(const Diagnosis& diagnosis);

}  // namespace mckibben::diagnose
