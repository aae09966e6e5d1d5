// Comma-separated values after RFC 4180, without line breaks inside cells; see the header.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/input/cells.hpp>
#include <sim/input/csv_layout.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/suggest.hpp>

namespace mckibben::input {
namespace {

Table find_columns(const Source& source, const CsvLayout& layout, std::span<const WantedColumn> wanted,
                   TableProblems& problems, MissingHint hint) {
  const std::vector<std::string_view> names(layout.headings.begin(), layout.headings.end());
  Table table;
  for (const WantedColumn& column : wanted) {
    const auto found = std::find(names.begin(), names.end(), column.in_file);
    if (found == names.end()) {
      if (column.needed)
        problems.add({layout.heading, 1},
                     fmt::format("the column {} is missing{} (found: {}){}", column.in_file,
                                 did_you_mean(column.in_file, names), join_few(names),
                                 hint == nullptr ? "" : hint(column, names)));
      continue;
    }
    const auto index = static_cast<std::size_t>(found - names.begin());
    const auto again = std::find(found + 1, names.end(), column.in_file);
    if (again != names.end())
      problems.add(
          source.place(layout.heading, layout.offsets[static_cast<std::size_t>(again - names.begin())]),
          fmt::format("repeated column {}", column.in_file));
    table.columns.push_back(
        {column.name, column.in_file, index, {}, column.may_miss, column.is_date, layout.units[index]});
  }
  return table;
}

std::string width_problem(std::size_t cells, std::size_t headings, char separator) {
  if (cells == 0) return "a quote is opened but not closed in this row";
  return fmt::format("this row has {} cells; the header has {}{}", cells, headings,
                     separator == ',' && cells > headings
                         ? "; with decimal commas columns must stand between semicolons or tabs"
                         : "");
}

}  // namespace

Table read_csv(const Source& source, std::span<const WantedColumn> wanted, TableProblems& problems,
               MissingHint hint) {
  if (!check_text(source, problems)) return {};
  const CsvLayout layout = layout_of(source, wanted);
  check_columns(layout.cells, {}, problems);
  if (problems.count() > 0) return {};
  Table table = find_columns(source, layout, wanted, problems, hint);
  table.separator = layout.separator;
  if (problems.count() > 0) return table;
  const std::size_t last = last_row_line(source);
  if (last < layout.first_row) problems.add({}, "there are no rows below the header");
  for (Table::Column& column : table.columns) column.values.reserve(last);
  table.lines.reserve(last);

  NumberReader numbers('\0');
  ClockReader clock;
  std::string problem;
  for (std::size_t line = layout.first_row; line <= last; ++line) {
    const std::vector<Cell> cells = row_cells(source, layout, line);
    const std::size_t headings = layout.headings.size();
    if (cells.size() != headings)
      problems.add({line, 1}, width_problem(cells.size(), headings, layout.separator));
    table.lines.push_back(line);
    for (Table::Column& column : table.columns) {
      const Cell cell = column.index < cells.size() ? cells[column.index] : Cell{};
      const auto value = column.is_date ? clock.read(column.in_file, cell, problem)
                                        : numbers.read(column.in_file, cell, problem);
      if (!value && cells.size() == headings && !(column.may_miss && is_missing(cell)))
        problems.add(source.place(line, cell.offset), problem);
      column.values.push_back(value.value_or(std::nan("")));  // keeps rows in step; never used
    }
  }
  return table;
}

Table read_table(const Source& source, std::span<const std::string_view> required,
                 std::span<const std::string_view> optional, TableProblems& problems) {
  std::vector<WantedColumn> wanted;
  for (const std::string_view name : required) wanted.push_back({std::string(name), std::string(name), true});
  for (const std::string_view name : optional)
    wanted.push_back({std::string(name), std::string(name), false});
  return read_csv(source, wanted, problems);
}

}  // namespace mckibben::input
