// Quantities made small: no more points than a screen has pixels, 16 bits each, as text (base64, RFC 4648).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <sim/report/contents.hpp>

namespace mckibben::report {

/// How many ticks become one column of pixels in a report of so many runs: 1 if all ticks fit.
std::size_t ticks_per_column(std::size_t ticks, std::size_t runs);

/// How many points `pack` makes: a tick each, or two for each column.
std::size_t points(std::size_t ticks, std::size_t per_column);

/// value = low + step * code, a code for each point; 65535 stands for none.
struct Packed {
  double low = 0.0, step = 0.0;
  std::string bits;  ///< the codes; empty: all values are `low`
};

/// Of each column of `per_column` ticks the smallest and the largest value are kept, in the order in which
/// they came. From tick `present` on there are no values.
Packed pack(const AtTick& at, std::size_t ticks, std::size_t present, std::size_t per_column);

/// Bytes in letters.
std::string base64(const std::vector<unsigned char>& bytes);

}  // namespace mckibben::report
