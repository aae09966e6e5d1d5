// Text tables that are too large to be kept, alone or together: every n-th of their lines, read block by
// block.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>

#include <sim/input/source.hpp>

namespace mckibben::input {

/// Of all files that are read together, each counted once.
std::uintmax_t bytes_of(std::set<std::filesystem::path> files);

/// None if the file is small enough, cannot be opened, or is no text of lines: then it is loaded as others
/// are. Whole are the first lines, where the table is looked for, and lines of words, which may begin a part.
/// `together`: bytes of all files that are read with it; limits are shared by size.
std::optional<Source> load_thinned(const std::filesystem::path& path, std::uintmax_t together = 0);

}  // namespace mckibben::input
