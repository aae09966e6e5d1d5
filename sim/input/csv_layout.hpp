// How a CSV file is laid out: what stands between its cells, which lines are heading, where its rows begin.
// Excel's first line `sep=;` is obeyed. Above the heading may stand what a recorder has to say, below it
// units.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sim/input/cells.hpp>
#include <sim/input/table.hpp>

namespace mckibben::input {

struct CsvLayout {
  char separator = ',';
  std::size_t heading = 1;            ///< the line that names the columns
  std::size_t first_row = 2;          ///< the line of the first numbers
  std::size_t cells = 0;              ///< of the heading
  std::vector<std::string> headings;  ///< without empty ones at the end
  std::vector<std::size_t> offsets;   ///< of these, in their line
  std::vector<std::string> units;     ///< as many, without brackets; empty where no line tells
};

/// The heading is the first line that has all the names that are needed, above the first row of numbers; else
/// the one that has most of them, or that has as many cells as that row.
CsvLayout layout_of(const Source& source, std::span<const WantedColumn> wanted);

/// The cells of a row, without empty ones beyond the headings.
std::vector<Cell> row_cells(const Source& source, const CsvLayout& layout, std::size_t line);

/// The last line that holds data: below it are blank ones, and such as hold nothing but separators.
std::size_t last_row_line(const Source& source);

/// A unit as a heading shows it, "[mA]" or "mA"; empty if it is none that anything here is measured in.
std::string unit_word(std::string_view text);

}  // namespace mckibben::input
