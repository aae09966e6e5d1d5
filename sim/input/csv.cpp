// Comma-separated values after RFC 4180, without line breaks inside cells; see the header.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <sim/input/csv.hpp>
#include <sim/input/number.hpp>
#include <sim/input/suggest.hpp>

namespace mckibben::input {
namespace {

constexpr std::size_t most_problems = 20;
constexpr double tick_tolerance_s = 1e-6;

struct Cell {
  std::string_view text;  ///< trimmed, without quotes
  std::size_t offset = 0;
  bool quoted = false;
};

/// Splits a line at its commas. Empty if a quote is not closed.
std::vector<Cell> split_cells(std::string_view line) {
  std::vector<Cell> cells;
  for (std::size_t start = 0; start <= line.size();) {
    bool in_quotes = false;
    std::size_t end = start;
    for (; end < line.size() && (in_quotes || line[end] != ','); ++end)
      if (line[end] == '"') in_quotes = !in_quotes;
    if (in_quotes) return {};
    Cell cell{trimmed(line.substr(start, end - start)), start};
    if (!cell.text.empty()) cell.offset = static_cast<std::size_t>(cell.text.data() - line.data());
    if (cell.text.size() >= 2 && cell.text.front() == '"' && cell.text.back() == '"') {
      cell.text = cell.text.substr(1, cell.text.size() - 2);
      cell.quoted = true;
    }
    cells.push_back(cell);
    start = end + 1;
  }
  return cells;
}

std::string number_problem(std::string_view name, const Cell& cell) {
  if (cell.quoted) return fmt::format("{}: a number must stand without quotes", name);
  if (cell.text.empty()) return fmt::format("{} is missing here", name);
  return fmt::format("{}: {}", name, why_no_number(cell.text.substr(0, 40)));
}

/// Lines that hold data: all after the header, without blank ones at the end.
std::size_t last_row_line(const Source& source) {
  std::size_t last = source.lines();
  while (last > 1 && trimmed(source.line(last)).empty()) --last;
  return last;
}

Table find_columns(const Source& source, const std::vector<Cell>& header,
                   std::span<const std::string_view> required, std::span<const std::string_view> optional,
                   TableProblems& problems) {
  std::vector<std::string_view> names;
  names.reserve(header.size());
  for (const Cell& cell : header) names.push_back(cell.text);
  Table table;
  const auto look_up = [&](std::string_view wanted, bool needed) {
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end()) {
      if (needed)
        problems.add({}, fmt::format("the column {} is missing{} (found: {})", wanted,
                                     did_you_mean(wanted, names), join(names)));
      return;
    }
    const auto index = static_cast<std::size_t>(found - names.begin());
    const auto again = std::find(found + 1, names.end(), wanted);
    if (again != names.end())
      problems.add(source.place(1, header[static_cast<std::size_t>(again - names.begin())].offset),
                   fmt::format("repeated column {}", wanted));
    table.columns.push_back({std::string(wanted), index, {}});
  };
  for (const std::string_view wanted : required) look_up(wanted, true);
  for (const std::string_view wanted : optional) look_up(wanted, false);
  return table;
}

}  // namespace

TableProblems::~TableProblems() {
  if (count_ > most_problems)
    problems_.error(source_, last_, fmt::format("and {} more problems in this file", count_ - most_problems));
}

void TableProblems::add(Place place, std::string message) {
  if (++count_ <= most_problems) problems_.error(source_, place, std::move(message));
  last_ = place;
}

const Table::Column* Table::find(std::string_view name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

Place Table::place(const Source& source, const Column& column, std::size_t row) {
  const std::size_t line = row + 2;
  const std::vector<Cell> cells = split_cells(source.line(line));
  return source.place(line, column.index < cells.size() ? cells[column.index].offset : 0);
}

Table read_table(const Source& source, std::span<const std::string_view> required,
                 std::span<const std::string_view> optional, TableProblems& problems) {
  if (source.text().size() > largest_csv_bytes) {
    problems.add({}, fmt::format("larger than {} MB", largest_csv_bytes >> 20U));
    return {};
  }
  if (const auto bad = source.first_bad_byte()) {
    problems.add(*bad, "this is not UTF-8 text");
    return {};
  }
  if (source.text().empty()) {
    problems.add({}, "the file is empty");
    return {};
  }
  const std::vector<Cell> header = split_cells(source.line(1));
  if (header.size() == 1 && source.line(1).find_first_of(";\t") != std::string_view::npos) {
    problems.add({}, "the columns must be separated by commas");
    return {};
  }
  Table table = find_columns(source, header, required, optional, problems);
  if (problems.count() > 0) return table;
  const std::size_t last = last_row_line(source);
  if (last == 1) problems.add({}, "there are no rows below the header");
  for (Table::Column& column : table.columns) column.values.reserve(last);

  for (std::size_t line = 2; line <= last; ++line) {
    const std::vector<Cell> cells = split_cells(source.line(line));
    if (cells.size() != header.size())
      problems.add({line, 1}, cells.empty() ? std::string("a quote is opened but not closed in this row")
                                            : fmt::format("this row has {} cells; the header has {}",
                                                          cells.size(), header.size()));
    for (Table::Column& column : table.columns) {
      const Cell cell = column.index < cells.size() ? cells[column.index] : Cell{};
      const auto value = cell.quoted ? std::nullopt : parse_number(cell.text);
      if (!value && cells.size() == header.size())
        problems.add(source.place(line, cell.offset), number_problem(column.name, cell));
      column.values.push_back(value.value_or(std::nan("")));  // keeps rows in step; never used
    }
  }
  return table;
}

void check_ticks(const Source& source, const Table& table, double tick_s, TableProblems& problems) {
  const Table::Column* column = table.find("time_s");
  if (column == nullptr || problems.count() > 0) return;
  const std::vector<double>& time_s = column->values;
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    const double expected_s = static_cast<double>(k) * tick_s;
    if (std::abs(time_s[k] - expected_s) <= tick_tolerance_s) continue;
    const double step_s = k > 0 ? time_s[k] - time_s[k - 1] : 0.0;
    std::string what = fmt::format("is not a tick of {} ms", 1e3 * tick_s);
    if (k == 0)
      what = "is not the beginning";
    else if (step_s == 0.0)
      what = "is repeated";
    else if (step_s < 0.0)
      what = "runs backwards";
    else if (step_s > 1.5 * tick_s)
      what = "comes after a gap";
    problems.add(Table::place(source, *column, k), fmt::format("time_s = {} {}: expected is {:.6g}",
                                                               write_number(time_s[k]), what, expected_s));
    return;
  }
}

void check_range(const Source& source, const Table::Column& column, double lowest, double highest,
                 std::string_view meaning, TableProblems& problems) {
  for (std::size_t row = 0; row < column.values.size(); ++row) {
    const double value = column.values[row];
    if (value < lowest || value > highest)
      problems.add(Table::place(source, column, row),
                   fmt::format("{} = {} is out of range: {:.6g} to {:.6g} ({})", column.name,
                               write_number(value), lowest, highest, meaning));
  }
}

void check_dac_range(const Source& source, const Table::Column& current, double largest_current_mA,
                     TableProblems& problems) {
  constexpr double slack_mA = 1e-9;  // shortest digits of a sum of DAC steps
  check_range(source, current, 0.0, largest_current_mA + slack_mA, "range of the rig's DAC", problems);
}

}  // namespace mckibben::input
