// Fuzz targets: one for each reader. Any bytes are read or refused with a proper problem; what was read and
// can be written reads back the same. Each has its corpus in the folder of its name.
#pragma once

#include <string>
#include <string_view>

namespace mckibben::fuzz {

using Target = void (*)(const std::string& bytes);

/// Null if there is none of that name. A target throws where its reader does not keep its word.
Target find_target(std::string_view name);

}  // namespace mckibben::fuzz
