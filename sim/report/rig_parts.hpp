// The rig as a small drawing, with numbered marks where on it something sits.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mckibben::report {

/// `guide`: what the load hangs on and runs along. `encoder`: the wheel and whatever reads it.
enum class Part { supply, command, valve, hose, muscle, threads, guide, encoder, gauge };

/// Where an effect of the catalogue sits, or a number of a rig file by its path (`hose.conductance`,
/// `effects.muscle_leak.conductance`); none for a name that it does not know.
std::optional<Part> part_of(std::string_view name);

/// The drawing (192 units wide, 150 high), as a part of a picture. Marks are numbered in this order from 1.
std::string rig_drawing(const std::vector<Part>& marks, bool with_gauge);

}  // namespace mckibben::report
