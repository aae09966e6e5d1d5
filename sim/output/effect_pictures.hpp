// What each effect does to the loop of pressure and contraction: the nominal rig in grey, the rig with the
// effect in colour, on a slow and on a fast ride up and down.
// The catalogue itself says how large an effect matters.
#pragma once

#include <string>
#include <string_view>

namespace mckibben::output {

/// The picture (SVG) of an effect of the catalogue, all its law variants in it. Throws std::invalid_argument
/// for a name without a law of its own.
std::string effect_svg(std::string_view effect);

}  // namespace mckibben::output
