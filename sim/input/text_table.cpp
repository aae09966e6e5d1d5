// Tables in text, found by their longest block of rows (text_layout.hpp); see readers.hpp.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/input/cells.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/number.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/suggest.hpp>
#include <sim/input/text_layout.hpp>

namespace mckibben::input {
namespace {

Table find_columns(const Source& source, const TextLayout& layout, std::span<const WantedColumn> wanted,
                   TableProblems& problems, MissingHint hint) {
  const std::vector<std::string_view> names(layout.headings.begin(), layout.headings.end());
  const Place head{std::max<std::size_t>(layout.heading, 1), 1};
  Table table;
  for (const WantedColumn& column : wanted) {
    const std::size_t index = index_of(layout, column.in_file);
    if (index == std::string_view::npos) {
      if (!column.needed) continue;
      problems.add(head, fmt::format("the column {} is missing{} (found: {}{}){}", column.in_file,
                                     did_you_mean(column.in_file, names), join_few(names),
                                     layout.heading == 0 ? "; no line names the columns" : "",
                                     hint == nullptr ? "" : hint(column, names)));
      continue;
    }
    const auto again =
        std::find(names.begin() + static_cast<std::ptrdiff_t>(index) + 1, names.end(), names[index]);
    if (again != names.end() && names[index] == column.in_file)
      problems.add(
          source.place(layout.heading, layout.offsets[static_cast<std::size_t>(again - names.begin())]),
          fmt::format("repeated column {}", column.in_file));
    const bool is_number =
        (layout.heading == 0 || names[index] != column.in_file) && parse_number(column.in_file).has_value();
    table.columns.push_back({.name = column.name,
                             .in_file = is_number ? "column " + column.in_file : column.in_file,
                             .index = index,
                             .values = {},
                             .may_miss = column.may_miss,
                             .kind = column.kind,
                             .unit = layout.units[index]});
  }
  return table;
}

/// Reads the cells of one column.
class ColumnReader {
 public:
  ColumnReader(Table::Column& column, NumberReader& numbers, EpochReader& epoch)
      : column_(column), numbers_(numbers), epoch_(epoch) {}

  /// False with a problem; what is missing where it may miss is none.
  bool read(const Cell& cell, std::string& problem) {
    const auto value = number(cell, problem);
    column_.values.push_back(value.value_or(std::nan("")));  // keeps rows in step
    return value.has_value() || (column_.may_miss && is_missing(cell));
  }

 private:
  std::optional<double> number(const Cell& cell, std::string& problem) {
    switch (column_.kind) {
      case CellKind::date:
        return clock_.read(column_.in_file, cell, problem);
      case CellKind::label:
        return column_.label(cell.text);
      case CellKind::stamp:
        return epoch_.read(column_.in_file, cell, numbers_, problem);
      case CellKind::number:
        break;
    }
    return numbers_.read(column_.in_file, cell, problem);
  }

  Table::Column& column_;
  NumberReader& numbers_;
  EpochReader& epoch_;
  ClockReader clock_;
};

std::string width_problem(const std::vector<Cell>& cells, const TextLayout& layout) {
  if (cells.empty()) return "a quote is opened but not closed in this row";
  return fmt::format(
      "this row has {} cells; the {} {}{}", cells.size(), layout.heading > 0 ? "header has" : "others have",
      layout.headings.size(),
      layout.separator == ',' ? "; with decimal commas columns must stand between semicolons or tabs" : "");
}

}  // namespace

Table read_text(const Source& source, std::span<const WantedColumn> wanted, TableProblems& problems,
                MissingHint hint) {
  if (!check_text(source, problems)) return {};
  const TextLayout layout = layout_of(source, wanted);
  if (!check_columns(layout.cells, {}, problems)) return {};
  if (!layout.problem.empty()) problems.add({layout.problem_line, 1}, layout.problem);
  if (layout.headings.empty()) problems.add({}, "there are no numbers in it");
  if (problems.count() > 0) return {};
  Table table = find_columns(source, layout, wanted, problems, hint);
  table.separator = layout.separator;
  if (problems.count() > 0) return table;

  if (layout.unread > 0)
    problems.note({layout.unread, 1},
                  fmt::format("this line is not read: it has other cells than the {} of the rows below",
                              layout.headings.size()));
  NumberReader numbers('\0');
  EpochReader epoch;
  std::vector<ColumnReader> readers;
  for (Table::Column& column : table.columns) readers.emplace_back(column, numbers, epoch);
  std::string problem;
  bool began = false;
  for (std::size_t line = layout.first_row; line <= layout.last_row; ++line) {
    const Line kind = kind_of(source, layout, line);
    if (kind != Line::row) {
      if ((kind == Line::heading || (kind == Line::remark && layout.separator != ' ')) && began)
        table.begin_part();
      continue;
    }
    began = true;
    const std::vector<Cell> cells = row_cells(source, layout, line);
    const bool whole = !cells.empty() && cells.size() <= layout.headings.size();
    if (!whole) problems.add({line, 1}, width_problem(cells, layout));
    table.lines.push_back(line);
    for (std::size_t i = 0; i < readers.size(); ++i) {
      const std::size_t index = table.columns[i].index;
      const Cell cell = index < cells.size() ? cells[index] : Cell{};
      if (!readers[i].read(cell, problem) && whole) problems.add(source.place(line, cell.offset), problem);
    }
  }
  if (table.lines.empty())
    problems.add({},
                 layout.heading > 0 ? "there are no rows below the header" : "there are no numbers in it");
  if (epoch.taken_off() && problems.count() == 0)
    problems.note(
        {table.lines.front(), 1},
        fmt::format("stamps begin at {}, as since 1970; times are those since this row", *epoch.taken_off()));
  return table;
}

Table read_table(const Source& source, std::span<const std::string_view> required,
                 std::span<const std::string_view> optional, TableProblems& problems) {
  std::vector<WantedColumn> wanted;
  for (const std::string_view name : required) wanted.push_back({std::string(name), std::string(name), true});
  for (const std::string_view name : optional)
    wanted.push_back({std::string(name), std::string(name), false});
  return read_text(source, wanted, problems);
}

}  // namespace mckibben::input
