// One law of a user's own, from the map that holds its keys (hypothesis_keys.hpp) to what the plant
// evaluates.
#pragma once

#include <sim/input/hypothesis_file.hpp>

namespace mckibben::input {

/// Without text, with problems, if something is wrong.
OwnLaw read_law(const Source& source, const Node& map, Problems& problems);

}  // namespace mckibben::input
