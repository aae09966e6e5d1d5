// Comma-separated values after RFC 4180, without line breaks inside cells; see the header.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/input/cells.hpp>
#include <sim/input/csv.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/number.hpp>
#include <sim/input/suggest.hpp>

namespace mckibben::input {
namespace {

/// Lines that hold data: all after the header, without blank ones at the end.
std::size_t last_row_line(const Source& source) {
  std::size_t last = source.lines();
  while (last > 1 && trimmed(source.line(last)).empty()) --last;
  return last;
}

/// What stands most often between the headings; a comma if nothing does.
char separator_of(std::string_view header) {
  constexpr std::string_view separators = ",;\t";
  return *std::max_element(separators.begin(), separators.end(), [&](char a, char b) {
    return split_cells(header, a).size() < split_cells(header, b).size();
  });
}

Table find_columns(const Source& source, const std::vector<Cell>& header,
                   std::span<const WantedColumn> wanted, TableProblems& problems, MissingHint hint) {
  std::vector<std::string_view> names;
  names.reserve(header.size());
  for (const Cell& cell : header) names.push_back(cell.text);
  Table table;
  for (const WantedColumn& column : wanted) {
    const auto found = std::find(names.begin(), names.end(), column.in_file);
    if (found == names.end()) {
      if (column.needed)
        problems.add({}, fmt::format("the column {} is missing{} (found: {}){}", column.in_file,
                                     did_you_mean(column.in_file, names), join_few(names),
                                     hint == nullptr ? "" : hint(column, names)));
      continue;
    }
    const auto index = static_cast<std::size_t>(found - names.begin());
    const auto again = std::find(found + 1, names.end(), column.in_file);
    if (again != names.end())
      problems.add(source.place(1, header[static_cast<std::size_t>(again - names.begin())].offset),
                   fmt::format("repeated column {}", column.in_file));
    table.columns.push_back({column.name, column.in_file, index, {}, column.may_miss});
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
  const char separator = separator_of(source.line(1));
  const std::vector<Cell> header = split_cells(source.line(1), separator);
  check_columns(header.size(), {}, problems);
  if (problems.count() > 0) return {};
  Table table = find_columns(source, header, wanted, problems, hint);
  table.separator = separator;
  if (problems.count() > 0) return table;
  const std::size_t last = last_row_line(source);
  if (last == 1) problems.add({}, "there are no rows below the header");
  for (Table::Column& column : table.columns) column.values.reserve(last);
  table.lines.reserve(last);

  NumberReader numbers(separator == ',' ? '.' : '\0');
  std::string problem;
  for (std::size_t line = 2; line <= last; ++line) {
    const std::vector<Cell> cells = split_cells(source.line(line), separator);
    if (cells.size() != header.size())
      problems.add({line, 1}, width_problem(cells.size(), header.size(), separator));
    table.lines.push_back(line);
    for (Table::Column& column : table.columns) {
      const Cell cell = column.index < cells.size() ? cells[column.index] : Cell{};
      const auto value = numbers.read(column.in_file, cell, problem);
      if (!value && cells.size() == header.size() && !(column.may_miss && is_missing(cell)))
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
