// How a table stands in a text. One rule: the table is the longest block of rows with as many cells, most of
// them numbers or stamps. The separator is the one that gives this block. Lines of words just above it with
// as many cells are headings and units; all that stands above them is remarks.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sim/input/cells.hpp>
#include <sim/input/table.hpp>

namespace mckibben::input {

struct TextLayout {
  char separator = ',';
  std::size_t heading = 0;                  ///< the line that names the columns; 0: none does
  std::size_t first_row = 1, last_row = 0;  ///< lines; between them may be blank ones and remarks
  std::size_t head = 1;                     ///< the first line of headings, or first_row
  std::size_t cells = 0;                    ///< of the widest line that was looked at
  std::vector<std::string> headings;        ///< where no line names the columns: their numbers, from 1
  std::vector<std::size_t> offsets;         ///< of these, in their line
  std::vector<std::string> units;           ///< as many, without brackets; empty where no line says any
  std::string problem;                      ///< why headings and rows do not belong together; empty: they do
  std::size_t problem_line = 0;
  std::size_t footer =
      0;  ///< the first of some lines below the table that begin with a word; 0: there are none
  std::size_t usual_cells = 0;      ///< of a row, with empty ones
  bool begins_with_number = false;  ///< the first cell of rows is one
  bool has_summaries = false;       ///< few rows begin with a word
  std::size_t between =
      0;  ///< the first line below the headings that is no row, as a remark on each column is
  std::size_t unread = 0;  ///< a line of numbers right above the table that is no row of it; 0: there is none
};

/// `wanted`: of several lines of words the one that has most of these names is the heading.
TextLayout layout_of(const Source& source, std::span<const WantedColumn> wanted);

/// What a line of a table is: a row, or nothing, a remark, its headings again (where a recorder began anew),
/// the headings or units of another table, sums or means of rows above.
enum class Line { row, blank, remark, heading, another, summary };
inline constexpr std::string_view another_table =
    "another table begins here, with other headings or units; put each into a file of its own";
Line kind_of(const Source& source, const TextLayout& layout, std::size_t line);

/// The cells of a line without empty ones beyond the headings; none if a quote is not closed.
std::vector<Cell> row_cells(const Source& source, const TextLayout& layout, std::size_t line);

/// Index of a column by its heading, without the mark of a remark before it, or by its number; none: npos.
std::size_t index_of(const TextLayout& layout, std::string_view name);

}  // namespace mckibben::input
