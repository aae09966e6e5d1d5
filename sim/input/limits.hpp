// How much is read of an input: what a rig gives in twelve hours, and so little that a file that is refused,
// whatever is in it, takes less than 1 GiB of memory.
#pragma once

#include <cstddef>
#include <string>

#include <sim/input/source.hpp>
#include <sim/input/table.hpp>

namespace mckibben::input {

inline constexpr std::size_t longest_line_bytes = 1U << 20U;  // in any text

// Of a table.
inline constexpr std::size_t most_text_bytes = 1U << 28U, most_mat_bytes = 1U << 27U, most_columns = 10'000,
                             most_rows = 4'000'000;

// Of YAML, beside its bytes (yaml_file.hpp).
inline constexpr std::size_t most_yaml_values = 500'000, deepest_yaml = 32;

// Of JSON.
inline constexpr std::size_t most_json_bytes = 1U << 26U, most_json_values = 1'000'000, deepest_json = 64;

/// Problems of the number of columns, which are named at `place`. False if there is one.
bool check_columns(std::size_t count, Place place, TableProblems& problems);

/// What is wrong with the length of a line, and which line it is; 0 if nothing is.
std::size_t first_long_line(const Source& source, std::string& problem);

}  // namespace mckibben::input
