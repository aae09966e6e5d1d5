// What each effect does to the loop of pressure and contraction: the nominal rig in grey, the rig with the
// effect in colour, on a slow and on a fast ride up and down.
// The catalogue itself says how large an effect matters.
#pragma once

#include <string>
#include <string_view>

#include <sim/domain/rig_file.hpp>

namespace mckibben::output {

/// The picture (SVG) of an effect of the catalogue, all its law variants in it, or of a law of the nominal
/// rig's own at its typical values. Throws std::invalid_argument for a name without a law of its own.
std::string effect_svg(std::string_view effect, const domain::RigFile& nominal = {});

}  // namespace mckibben::output
