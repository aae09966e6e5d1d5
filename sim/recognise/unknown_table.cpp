// By the readers that data sets are read with; see the header.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <sim/formats/mat_file.hpp>
#include <sim/input/csv_layout.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/number.hpp>
#include <sim/input/readers.hpp>
#include <sim/recognise/unknown_table.hpp>

namespace mckibben::recognise {
namespace {

using input::Cell, input::Source;

/// A column as it grows, row by row.
struct Growing {
  UnknownColumn column;
  input::ClockReader clock;
  std::size_t numbers = 0, dates = 0, words = 0;
  std::vector<double> times;

  void add(const Cell& cell, input::NumberReader& reader) {
    std::string problem;
    const auto number = reader.read("", cell, problem);
    const auto time = number ? std::nullopt : clock.read("", cell, problem);
    numbers += number ? 1 : 0;
    dates += time ? 1 : 0;
    words += !number && !time && !input::is_missing(cell) ? 1 : 0;
    column.values.push_back(number.value_or(std::nan("")));
    times.push_back(time.value_or(std::nan("")));
  }
  /// Numbers, or dates, for the most part.
  bool is_of_use() {
    if (dates > numbers && dates > words) {
      column.is_date = true;
      column.values = std::move(times);
      return true;
    }
    return numbers > 0 && numbers >= words;
  }
};

void keep(std::vector<Growing>& all, UnknownTable& table) {
  for (Growing& each : all) {
    if (each.is_of_use())
      table.columns.push_back(std::move(each.column));
    else if (!each.column.name.empty())
      table.words.push_back(each.column.name);
  }
}

void read_headed(const Source& source, UnknownTable& table) {
  const input::CsvLayout layout = input::layout_of(source, {});
  for (std::size_t line = 1; line < layout.heading; ++line) table.remarks.emplace_back(source.line(line));
  std::vector<Growing> all(layout.headings.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].column.name = layout.headings[i];
    all[i].column.unit = layout.units[i];
  }
  input::NumberReader reader('\0');
  for (std::size_t line = layout.first_row; line <= input::last_row_line(source); ++line) {
    const std::vector<Cell> cells = input::row_cells(source, layout, line);
    for (std::size_t i = 0; i < all.size(); ++i) all[i].add(i < cells.size() ? cells[i] : Cell{}, reader);
  }
  keep(all, table);
}

void read_numbers(const Source& source, UnknownTable& table) {
  table.has_headings = false;
  std::vector<Growing> all;
  input::NumberReader reader('\0');
  for (std::size_t line = 1; line <= source.lines(); ++line) {
    const std::string_view text = input::trimmed(source.line(line));
    if (text.empty()) continue;
    if (text.starts_with('#') || text.starts_with('%')) {
      table.remarks.emplace_back(text);
      continue;
    }
    const std::vector<Cell> cells = input::split_cells(text, ' ');
    for (std::size_t i = all.size(); all.empty() && i < cells.size(); ++i) {
      all.resize(cells.size());
      for (std::size_t k = 0; k < all.size(); ++k) all[k].column.name = std::to_string(k + 1);
    }
    for (std::size_t i = 0; i < all.size(); ++i) all[i].add(i < cells.size() ? cells[i] : Cell{}, reader);
  }
  keep(all, table);
}

void read_labview(const Source& source, UnknownTable& table) {
  table.time_is_inside = true;
  std::vector<input::WantedColumn> wanted;
  for (auto& name : input::lvm_channels(source)) wanted.push_back({name, name, false, true});
  input::Problems problems;
  input::Table found;
  {
    input::TableProblems said(source, problems);
    found = input::read_lvm(source, wanted, 0, said);
  }
  problems.raise();
  for (input::Table::Column& column : found.columns)
    table.columns.push_back({column.name, "", false, std::move(column.values)});
}

/// Vectors of the greatest length; shorter ones are settings.
void read_matlab(const Source& source, UnknownTable& table) {
  std::vector<std::string> names;
  std::vector<formats::Found> found;
  try {
    names = formats::read_mat(source.text(), {}).names;
    found = formats::read_mat(source.text(), names).found;
  } catch (const formats::BadFile& bad) {
    throw input::BadInput({{input::Severity::error, source.name(), input::nowhere, bad.what(), ""}});
  }
  std::size_t rows = 0;
  for (const formats::Found& each : found) rows = std::max(rows, each.values.size());
  for (std::size_t i = 0; i < found.size() && rows > 1; ++i) {
    if (found[i].values.size() == rows)
      table.columns.push_back({names[i], "", false, std::move(found[i].values)});
    else
      table.words.push_back(names[i]);
  }
}

}  // namespace

UnknownTable read_unknown(const std::filesystem::path& path) {
  UnknownTable table;
  table.path = path;
  const auto format = input::format_of(path.string());
  const auto refuse = [&](std::string why) {
    throw input::BadInput({{input::Severity::error, path.string(), input::nowhere, std::move(why), ""}});
  };
  if (!format) {
    const std::string ending = path.extension().string();
    const bool is_sheet = ending == ".xlsx" || ending == ".xls" || ending == ".ods";
    refuse(std::string(input::format_rule) + (is_sheet ? "; save the sheet as CSV" : ""));
  }
  Source source = Source::load(path, input::most_text_bytes);
  table.input = {source.name(), source.sha256()};
  if (*format != input::Format::mat) {
    const bool is_text = source.text().find('\0') == std::string::npos;
    if (is_text && source.first_bad_byte()) source.reread_as_latin1();
    input::Problems problems;
    {
      input::TableProblems said(source, problems);
      input::check_text(source, said);
    }
    problems.raise();
  }
  if (*format == input::Format::csv) read_headed(source, table);
  if (*format == input::Format::ascii) read_numbers(source, table);
  if (*format == input::Format::lvm) read_labview(source, table);
  if (*format == input::Format::mat) read_matlab(source, table);
  if (table.columns.empty()) refuse("no column of numbers is found in it");
  return table;
}

}  // namespace mckibben::recognise
