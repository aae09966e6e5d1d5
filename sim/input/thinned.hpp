// Text tables that are too large to be kept: every n-th of their lines, read block by block.
#pragma once

#include <filesystem>
#include <optional>

#include <sim/input/source.hpp>

namespace mckibben::input {

/// None if the file is small enough, cannot be opened, or is no text of lines: then it is loaded as others
/// are. Whole are the first lines, where the table is looked for, and lines of words, which may begin a part.
std::optional<Source> load_thinned(const std::filesystem::path& path);

}  // namespace mckibben::input
