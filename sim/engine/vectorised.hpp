// Rigs of one kind as one rig whose numbers are SIMD lanes: parameters gathered by their field lists, so that
// none can be forgotten.
#pragma once

#include <optional>
#include <span>

#include <plant/plant.hpp>
#include <sim/engine/lanes.hpp>

namespace mckibben::engine {

/// The plants, and the first again where there are fewer than lanes; nothing if they differ in more than
/// numbers (friction law, variant of an effect that two of them have). All of one muscle each, or of two.
std::optional<plant::PlantOf<Lanes>> vectorised(std::span<const plant::Plant> plants);

/// What one of them holds, in its lane. All of them are driven alike: a pressure, a length is given to all or
/// to none.
void put(const plant::Held& held, std::size_t lane, plant::HeldOf<Lanes>& all);

}  // namespace mckibben::engine
