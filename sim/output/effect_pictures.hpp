// What each effect does to the loop of pressure and contraction: the nominal rig in grey, the rig with the
// effect in colour, on a slow and on a fast ride up and down.
// The catalogue itself says how large an effect matters.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <controllers/waveform.hpp>
#include <plant/rig.hpp>

namespace mckibben::output {

/// The picture (SVG) of an effect of the catalogue, all its law variants in it, or of a law of the nominal
/// rig's own at its typical values. Throws std::invalid_argument for a name without a law of its own.
std::string effect_svg(std::string_view effect, const plant::Rig& nominal = {});

/// The loop that one sees from outside: the pressure that the current asks for [bar], or that a gauge shows,
/// and the contraction ratio as the encoder has it, at each tick of a ride.
/// Throws std::runtime_error if the rig cannot follow.
std::vector<std::pair<double, double>> loop_of(const plant::Rig& rig, double load_kg,
                                               const controllers::TriangleCurrent& current, double duration_s,
                                               bool gauge = false);

}  // namespace mckibben::output
