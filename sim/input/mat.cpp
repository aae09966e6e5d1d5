// Tables in MAT-files; see the header.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/formats/mat_file.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/suggest.hpp>

namespace mckibben::input {
namespace {

/// What there is, if what was wanted is not among it.
std::string found_names(const std::vector<std::string>& names, const std::string& wanted) {
  if (std::find(names.begin(), names.end(), wanted.substr(0, wanted.find('('))) != names.end()) return "";
  const std::vector<std::string_view> known(names.begin(), names.end());
  if (known.empty()) return " (found: no variable of numbers)";
  return fmt::format("{} (found: {})", did_you_mean(wanted, known), join_few(known));
}

void check_numbers(Table& table, TableProblems& problems) {
  const std::vector<double>& first = table.columns.front().values;
  for (Table::Column& column : table.columns) {
    if (column.values.size() != first.size())
      problems.add(nowhere, fmt::format("{} has {} numbers and {} has {}; there must be as many",
                                        table.columns.front().in_file, first.size(), column.in_file,
                                        column.values.size()));
    for (std::size_t row = 0; row < column.values.size(); ++row) {
      if (std::isfinite(column.values[row]) || (column.may_miss && std::isnan(column.values[row]))) continue;
      problems.add(table, column, row, fmt::format("{} is not a finite number", column.values[row]));
      column.values[row] = std::nan("");  // is in no range, so nothing more is said of it
    }
  }
}

}  // namespace

Table read_mat_table(const Source& source, std::span<const WantedColumn> wanted, TableProblems& problems) {
  if (source.text().size() > most_mat_bytes) {
    problems.add(nowhere, fmt::format("larger than {} MB", most_mat_bytes >> 20U));
    return {};
  }
  Table table;
  std::vector<std::string> names;
  names.reserve(wanted.size());
  for (const WantedColumn& column : wanted) names.push_back(column.in_file);
  try {
    formats::MatContents contents = formats::read_mat(source.text(), names);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      formats::Found& found = contents.found[i];
      if (found.problem.empty())
        table.columns.push_back(
            {wanted[i].name, wanted[i].in_file, i, std::move(found.values), wanted[i].may_miss});
      else if (wanted[i].needed)
        problems.add(nowhere, found.problem + found_names(contents.names, names[i]));
    }
  } catch (const formats::BadFile& bad) {
    problems.add(nowhere, bad.what());
  }
  for (const Table::Column& column : table.columns)
    if (column.values.size() > most_rows)
      problems.add(nowhere, fmt::format("{} has {} numbers; at most {} are read", column.in_file,
                                        column.values.size(), most_rows));
  if (problems.count() == 0) check_numbers(table, problems);
  return table;
}

}  // namespace mckibben::input
