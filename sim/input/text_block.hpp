// The longest block of rows with as many cells, most of them numbers or stamps, and what its lines are made
// of.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include <sim/input/cells.hpp>
#include <sim/input/source.hpp>

namespace mckibben::input {

/// What may stand between cells; a blank stands for any number of blanks.
inline constexpr std::string_view separators = "\t;,| ";

/// Nothing but separators, or a line that is ruled.
bool is_blank(std::string_view line);
/// `#`, `%` or `//` before a heading or a remark; and what stands behind.
bool is_marked(std::string_view line);
std::string_view without_mark(std::string_view text);

/// Letters, blanks, points and colons alone.
bool is_word(std::string_view text);

/// Cells of a line without empty ones at its end.
std::size_t trimmed_size(const std::vector<Cell>& cells);

/// How much of a line is numbers.
struct Numbers {
  std::size_t cells = 0, numbers = 0, empty = 0;
  bool is_row() const { return numbers > 0 && 2 * (numbers + empty) >= cells; }
};
Numbers numbers_in(const std::vector<Cell>& cells);

/// A block of rows with as many cells.
struct Block {
  char separator = ',';
  std::size_t first = 0, rows = 0, raw = 0, width = 0;
  double score = 0.0;  ///< rows, each by its share of numbers, squared: keys beside values are no table
};

/// From line `from` on. `said`: the separator that the file names. No rows: there is none.
Block block_of(const Source& source, std::optional<char> said, std::size_t from);

/// With the rows of numbers above it that have fewer cells, and a few that have more.
Block with_ragged(const Source& source, const Block& found_first, std::size_t from);

}  // namespace mckibben::input
