// Tables in text, found by their longest block of rows (text_layout.hpp); see readers.hpp.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/input/cells.hpp>
#include <sim/input/column_hints.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/number.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/spelling.hpp>
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
                             .unit = layout.units[index],
                             .own_clock = column.own_clock});
  }
  for (std::size_t k = 0; k < names.size(); ++k)
    if (std::ranges::find(table.columns, k, &Table::Column::index) == table.columns.end())
      table.others.emplace_back(names[k]);
  return table;
}

/// Reads the cells of one column.
class ColumnReader {
 public:
  ColumnReader(Table::Column& column, char decimal, EpochReader& epoch)
      : column_(column), numbers_(decimal), epoch_(epoch) {}

  /// False with a problem; what is missing where it may miss is none.
  bool read(const Cell& cell, std::string& problem) {
    const auto value = number(cell, problem);
    column_.values.push_back(value.value_or(std::nan("")));  // keeps rows in step
    return value.has_value() || (column_.may_miss && is_missing(cell));
  }

 private:
  std::optional<double> number(Cell cell, std::string& problem) {
    if (column_.kind != CellKind::date && column_.kind != CellKind::label && !take_unit(cell, column_.unit)) {
      problem =
          fmt::format("{} is not in {}, as those above are, or their heading says", cell.text, column_.unit);
      return std::nullopt;
    }
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
  NumberReader numbers_;
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

/// The numbers of a column in the rows of a table; NaN where there is none.
std::vector<double> numbers_of(const Source& source, const TextLayout& layout, const Table& table,
                               std::size_t index, char decimal) {
  NumberReader numbers(decimal);
  EpochReader epoch;
  std::string problem;
  std::vector<double> values;
  for (const std::size_t line : table.lines) {
    const std::vector<Cell> cells = row_cells(source, layout, line);
    const auto value = index < cells.size() ? epoch.read("", cells[index], numbers, problem) : std::nullopt;
    values.push_back(value.value_or(std::nan("")));
  }
  return values;
}

/// Whether stamps say another time than these, in whatever unit.
bool differ(const std::vector<double>& stamps, const std::vector<double>& others) {
  constexpr double same = 1e-3, least_rows = 3.0;
  double first = std::nan(""), last = first, own = 0.0, other = 0.0, step = 0.0, rows = 0.0, rises = 0.0;
  for (std::size_t k = 0; k < stamps.size(); ++k) {
    if (std::isnan(stamps[k]) || std::isnan(others[k])) continue;
    if (std::isnan(first)) first = stamps[k], last = others[k], own = stamps[k], other = others[k];
    if (others[k] < last || stamps[k] < first) return false;  // no clock, or a new run
    step = std::max(step, others[k] - last);
    rises += others[k] > last ? 1.0 : 0.0;
    last = others[k];
    first = stamps[k];
    ++rows;
  }
  own = first - own;
  other = last - other;
  if (rows < least_rows || 2.0 * rises < rows || !(own > 0.0) || !(other > 0.0)) return false;
  const double power = std::pow(1000.0, std::round(std::log10(other / own) / 3.0));
  return std::abs(other - power * own) > same * other + step;
}

/// The clock that stands before a quantity is that quantity's, or says the same as the one that is read.
void check_clocks(const Source& source, const TextLayout& layout, const Look& look, const Table& table,
                  TableProblems& problems) {
  const Table::Column* time = table.find("time_s");
  if (time == nullptr || time->kind == CellKind::date || problems.count() > 0) return;
  const auto clock_of = [&](const Table::Column& column) {
    std::size_t clock = time->index;
    for (std::size_t k = 0; k < column.index; ++k)
      if (k == time->index || names_time(layout.headings[k])) clock = k;
    return clock;
  };
  for (const Table::Column& column : table.columns) {
    if (&column == time || column.kind != CellKind::number) continue;
    const std::size_t clock = clock_of(column);
    if (clock == time->index || column.own_clock ||
        !differ(time->values, numbers_of(source, layout, table, clock, look.columns[clock].decimal)))
      continue;
    problems.add(
        source.place(layout.heading, layout.offsets[clock]),
        fmt::format("{0} is another clock than {1}, and stands before {2}: write time: {0} in the place "
                    "of {2}, or time: {1} if its stamps are those",
                    layout.headings[clock], time->in_file, column.in_file));
  }
}

}  // namespace

std::string note_of_thinned(const Source& source) {
  if (source.thinned().step == 1) return "";
  return fmt::format(
      "{} lines, with those of the other files, are more than are read at once: 1 in {} is read; for all "
      "rows "
      "of a part, put it into a data set of its own",
      source.thinned().lines, source.thinned().step);
}

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
  if (layout.footer > 0)
    problems.note({layout.footer, 1},
                  "this line and those below begin with a word, where rows have a number: not read");
  if (layout.between > 0)
    problems.note({layout.between, 1}, "this line between the headings and the first row is not read");
  const Look look = look_at(source, layout);
  if (look.another_heading > 0) problems.add({look.another_heading, 1}, std::string(another_table));
  const Table::Column* const time = table.find("time_s");
  const bool has_stamps = time != nullptr && time->kind != CellKind::number;
  const bool leaves_out = look.short_rows > 0 && has_stamps;
  if (look.blank_cells > 0 && has_stamps)
    problems.add({look.blank_cells, 1}, std::string(lost_between_blanks));
  if (problems.count() > 0) return table;
  if (leaves_out)
    problems.note({look.first_short, 1}, look.note_of_short_rows(source.line_in_file(look.first_short)));
  if (look.summaries > 0)
    problems.note({look.first_summary, 1}, look.note_of_summaries(source.line_in_file(look.first_summary)));
  EpochReader epoch;
  std::vector<ColumnReader> readers;
  for (Table::Column& column : table.columns)
    readers.emplace_back(column, look.columns[column.index].decimal, epoch);
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
    if (leaves_out && look.lacks_cells(layout, cells)) continue;
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
  check_clocks(source, layout, look, table, problems);
  if (const std::string note = note_of_thinned(source); !note.empty() && problems.count() == 0)
    problems.note({table.lines.front(), 1}, note);
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
