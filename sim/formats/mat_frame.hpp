// The frame of a MAT-file: that its variables are whole. libmatio trusts the sizes that stand in a file,
// gives numbers for those that are not there, and does not look at zlib's check sums.
#pragma once

#include <cstddef>
#include <string_view>

namespace mckibben::formats {

inline constexpr std::size_t most_numbers = 1U << 24U;  // of a variable: a million ticks in sixteen columns

/// Throws BadFile if these are not the bytes of a whole MAT-file of level 5; tells what they are instead,
/// where it can be told, and what to do.
void check_mat_frame(std::string_view bytes);

}  // namespace mckibben::formats
