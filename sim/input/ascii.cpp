// Tables without a heading; see the header.
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/input/cells.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/number.hpp>
#include <sim/input/readers.hpp>

namespace mckibben::input {
namespace {

constexpr char any_blanks = ' ';
constexpr const char* no_heading = " (files of this ending hold no headings)";

std::size_t number_of(const WantedColumn& column) {
  std::size_t number = 0;
  std::from_chars(column.in_file.data(), column.in_file.data() + column.in_file.size(), number);
  return number;
}

bool is_remark(std::string_view line) {
  return line.starts_with('#') || line.starts_with('%');
}

}  // namespace

Table read_ascii(const Source& source, std::span<const WantedColumn> wanted, TableProblems& problems) {
  if (!check_text(source, problems)) return {};
  Table table;
  table.separator = any_blanks;
  for (const WantedColumn& column : wanted)
    table.columns.push_back(
        {column.name, fmt::format("column {}", column.in_file), number_of(column) - 1, {}, column.may_miss});
  std::size_t last = source.lines();
  while (last > 0 && trimmed(source.line(last)).empty()) --last;

  NumberReader numbers('\0');
  std::string problem;
  std::size_t width = 0, first = 0;
  for (std::size_t line = 1; line <= last; ++line) {
    if (is_remark(source.line(line))) continue;
    const std::vector<Cell> cells = split_cells(source.line(line), any_blanks);
    if (first == 0) {
      first = line;
      width = cells.size();
      check_columns(width, {line, 1}, problems);
      for (const Table::Column& column : table.columns)
        if (column.index >= width)
          problems.add({line, 1}, fmt::format("there is no {}: this row has {}", column.in_file, width));
      if (problems.count() > 0) return table;
    }
    if (cells.size() != width)
      problems.add({line, 1},
                   fmt::format("this row has {} numbers; line {} has {}", cells.size(), first, width));
    table.lines.push_back(line);
    for (Table::Column& column : table.columns) {
      const Cell cell = column.index < cells.size() ? cells[column.index] : Cell{};
      const auto value = numbers.read(column.in_file, cell, problem);
      if (!value && cells.size() == width && !(column.may_miss && is_missing(cell)))
        problems.add(source.place(line, cell.offset), line == first ? problem + no_heading : problem);
      column.values.push_back(value.value_or(std::nan("")));  // keeps rows in step; never used
    }
  }
  if (first == 0) problems.add({}, "there are no numbers in it");
  return table;
}

}  // namespace mckibben::input
