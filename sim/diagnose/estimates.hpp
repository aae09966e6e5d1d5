// The numbers of the final fit with their intervals, each filed where it belongs: under an effect, the law,
// or what has moved and what absorbed what.
#pragma once

#include <string>
#include <vector>

#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/fit.hpp>
#include <sim/diagnose/interval.hpp>

namespace mckibben::diagnose {

/// What a term of a law stands for: "P e", "sin(2 pi x / 12.000 mm + 0.40 rad)".
std::string words(const plant::ForceTerm& term);

/// Files the free parameters of the final fit under effects, law and nominal parameters. `bounds`: one for
/// each free parameter; `recalibrated`: the rig fitted without effects.
void tell_parameters(Diagnosis& diagnosis, const Model& model, const std::vector<Bounds>& bounds,
                     const Rig& recalibrated);

}  // namespace mckibben::diagnose
