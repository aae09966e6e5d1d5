// A look at all rows of a table before any of its numbers is read: the decimal sign of each column, rows that
// have lost cells, another table below.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <sim/input/text_layout.hpp>

namespace mckibben::input {

struct ColumnSpelling {
  char decimal = '.';
  std::string either{};  ///< a number that may have decimals or thousands, where nothing tells; else empty
};

/// What all rows of a table tell together.
struct Look {
  std::vector<ColumnSpelling> columns;
  char decimal = '\0';                          ///< of all columns; 0: none tells
  std::size_t short_rows = 0, first_short = 0;  ///< a few that have lost cells: how many, and the first line
  std::size_t summaries = 0, first_summary = 0;
  std::size_t another_heading = 0;  ///< its line; 0: there is none
  std::size_t blank_cells = 0;      ///< the first line of many between blanks that lack cells; 0: none

  /// Whether a row has lost cells, nobody knows which.
  bool lacks_cells(const TextLayout& layout, const std::vector<Cell>& cells) const {
    return short_rows > 0 && !cells.empty() && cells.size() < layout.usual_cells;
  }
  std::string note_of_short_rows(std::size_t line_in_file) const;
  std::string note_of_summaries(std::size_t line_in_file) const;
};

inline constexpr std::string_view lost_between_blanks =
    "this row, as others, lacks cells, and between blanks it does not say which; save it with tabs or commas";

/// The first column with decimals tells the sign of all, else one that goes on from 996 to 1,008. Where
/// nothing does, each column's sign counts as decimal.
Look look_at(const Source& source, const TextLayout& layout);

}  // namespace mckibben::input
