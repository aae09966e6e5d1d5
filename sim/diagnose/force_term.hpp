// Terms of a law of force, in words.
#pragma once

#include <string>

#include <plant/rig.hpp>

namespace mckibben::diagnose {

/// What a term stands for: "P e", "sin(2 pi x / 12.000 mm + 0.40 rad)".
std::string words(const plant::ForceTerm& term);

}  // namespace mckibben::diagnose
