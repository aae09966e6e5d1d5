// Places and checks of tables; see the header.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include <sim/input/cells.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/number.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/table.hpp>

namespace mckibben::input {
namespace {

constexpr std::size_t most_problems = 20;
// Clocks in single precision are off by more the longer they run.
constexpr double tick_tolerance_s = 1e-6, tick_tolerance_ratio = 2e-7;

}  // namespace

const Table::Column* Table::find(std::string_view name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

Table::Column* Table::find(std::string_view name) {
  return const_cast<Column*>(std::as_const(*this).find(name));
}

double Table::Column::label(std::string_view text) {
  const auto known = labels.find(text);
  if (known != labels.end()) return known->second;
  return labels.emplace(text, static_cast<double>(labels.size())).first->second;
}

void Table::begin_part() {
  if (!lines.empty() && (parts.empty() || parts.back() != lines.size())) parts.push_back(lines.size());
}

Place Table::place(const Source& source, const Column& column, std::size_t row) const {
  if (lines.empty()) return nowhere;
  const std::vector<Cell> cells = split_cells(source.line(lines[row]), separator);
  return source.place(lines[row], column.index < cells.size() ? cells[column.index].offset : 0);
}

TableProblems::~TableProblems() {
  if (count_ > most_problems)
    problems_.error(source_, last_, fmt::format("and {} more problems in this file", count_ - most_problems));
}

void TableProblems::add(Place place, std::string message, bool of_column) {
  if (++count_ <= most_problems) problems_.error(source_, place, std::move(message), of_column);
  last_ = place;
}

namespace {

/// A number without a place is told by the name and number that it has in the file.
std::string of_number(const Table& table, const Table::Column& column, std::size_t row,
                      const std::string& message) {
  if (table.lines.empty()) return fmt::format("{}({}): {}", column.in_file, row + 1, message);
  return column.in_file == column.name ? message : fmt::format("{}: {}", column.in_file, message);
}

}  // namespace

void TableProblems::add(const Table& table, const Table::Column& column, std::size_t row,
                        const std::string& message, bool of_column) {
  add(table.lines.empty() ? nowhere : table.place(source_, column, row),
      of_number(table, column, row, message), of_column);
}

void TableProblems::note(const Table& table, const Table::Column& column, std::size_t row,
                         const std::string& message) {
  note(table.lines.empty() ? nowhere : table.place(source_, column, row),
       of_number(table, column, row, message));
}

bool check_text(const Source& source, TableProblems& problems) {
  std::string problem;
  if (source.text().size() > most_text_bytes)
    problems.add({}, fmt::format("larger than {} MB", most_text_bytes >> 20U));
  else if (source.lines() > most_rows)
    problems.add({most_rows + 1, 1}, fmt::format("more than {} rows", most_rows));
  else if (const std::size_t line = first_long_line(source, problem); line > 0)
    problems.add({line, 1}, problem);
  else if (const auto bad = source.first_bad_byte())
    problems.add(*bad, "this is not UTF-8 text");
  else if (source.text().empty())
    problems.add({}, "the file is empty");
  return problems.count() == 0;
}

namespace {

void check_ticks_of(const Table& table, const Table::Column& column, double tick_s, TableProblems& problems,
                    std::string_view way_out) {
  const std::vector<double>& time_s = column.values;
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    const double expected_s = static_cast<double>(k) * tick_s;
    if (std::abs(time_s[k] - expected_s) <= tick_tolerance_s + tick_tolerance_ratio * expected_s) continue;
    const double step_s = k > 0 ? time_s[k] - time_s[k - 1] : 0.0;
    const std::string unlike = fmt::format("is not a tick of {} ms", 1e3 * tick_s);
    std::string what = unlike;
    if (k == 0)
      what = "is not the beginning";
    else if (step_s == 0.0)
      what = "is repeated";
    else if (step_s < 0.0)
      what = "runs backwards";
    else if (step_s > 1.5 * tick_s)
      what = "comes after a gap";
    const std::string around =
        fmt::format("; the run could end before it, to: {} s, or begin after it, from: {} s",
                    write_number(time_s[k - std::min<std::size_t>(k, 1)]), write_number(time_s[k]));
    problems.add(
        table, column, k,
        fmt::format("time_s = {} {}: expected is {:.6g}{}", write_number(time_s[k]), what, expected_s,
                    what == unlike          ? way_out
                    : what.ends_with("gap") ? around
                                            : ""));
    return;
  }
}

}  // namespace

void check_ticks(const Table& table, double tick_s, TableProblems& problems, std::string_view way_out) {
  if (problems.count() > 0) return;
  for (const Table::Column& column : table.columns)
    if (column.name == "time_s" && problems.count() == 0)
      check_ticks_of(table, column, tick_s, problems, way_out);
}

void check_range(const Table& table, const Table::Column& column, double lowest, double highest,
                 std::string_view meaning, TableProblems& problems) {
  for (std::size_t row = 0; row < column.values.size(); ++row) {
    const double value = column.values[row];
    if (value < lowest || value > highest)
      problems.add(table, column, row,
                   fmt::format("{} = {} is out of range: {:.6g} to {:.6g} ({})", column.name,
                               write_number(value), lowest, highest, meaning));
  }
}

std::size_t first_long_line(const Source& source, std::string& problem) {
  for (std::size_t number = 1; number <= source.lines(); ++number) {
    const std::size_t bytes = source.line(number).size();
    if (bytes <= longest_line_bytes) continue;
    problem = fmt::format("this line has {} bytes; at most {} are read", bytes, longest_line_bytes);
    return number;
  }
  return 0;
}

bool check_columns(std::size_t count, Place place, TableProblems& problems) {
  if (count > most_columns)
    problems.add(place, fmt::format("there are {} columns; at most {} are read", count, most_columns));
  return count <= most_columns;
}

Format format_of(const std::string& file, std::string_view text) {
  const std::string ending = lower(std::filesystem::path(file).extension().string());
  if (text.starts_with("LabVIEW Measurement")) return Format::lvm;  // .lvm without a header is a text
  return ending == ".mat" || text.starts_with("MATLAB 5.0 MAT-file") ? Format::mat : Format::text;
}

}  // namespace mckibben::input
