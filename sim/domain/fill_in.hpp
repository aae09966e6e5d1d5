// What stands in a file in place of a value that nobody could guess. Every reader refuses it.
#pragma once

#include <string_view>

namespace mckibben::domain {

inline constexpr std::string_view fill_in = "FILL_IN";

}  // namespace mckibben::domain
