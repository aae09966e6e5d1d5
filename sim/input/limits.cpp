// Columns and lines; see the header.
#include <fmt/format.h>

#include <sim/input/limits.hpp>

namespace mckibben::input {

std::size_t first_long_line(const Source& source, std::string& problem) {
  for (std::size_t number = 1; number <= source.lines(); ++number) {
    const std::size_t bytes = source.line(number).size();
    if (bytes <= longest_line_bytes) continue;
    problem = fmt::format("this line has {} bytes; at most {} are read", bytes, longest_line_bytes);
    return number;
  }
  return 0;
}

bool check_columns(std::size_t count, Place place, TableProblems& problems) {
  if (count > most_columns)
    problems.add(place, fmt::format("there are {} columns; at most {} are read", count, most_columns));
  return count <= most_columns;
}

}  // namespace mckibben::input
