// Muscles by catalogue: rig files in scenarios/rigs, each number there with its source. They are built into
// the program by cmake/embed.cmake.
#pragma once

#include <string_view>

namespace mckibben::input {

extern const std::string_view festo_dmsp_5, festo_dmsp_10, festo_dmsp_20, festo_dmsp_40, home_made;

}  // namespace mckibben::input
