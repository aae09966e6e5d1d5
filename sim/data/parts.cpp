// See the header.
#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <utility>

#include <sim/data/parts.hpp>

namespace mckibben::data {
namespace {

constexpr std::size_t parts = 4, least_rows = 25;  // of each

}  // namespace

domain::Run beginning_of(domain::Run run, std::size_t rows) {
  if (rows >= run.rows()) return run;
  for (auto* column : {&run.current_mA, &run.time_s})
    if (!column->empty()) column->resize(rows);
  for (domain::Reading& reading : run.readings) {
    reading.values.resize(rows);
    if (!reading.missing.empty()) reading.missing.resize(rows);
  }
  for (auto* driving : {&run.measured, &run.shaken})
    if (*driving) (*driving)->rows.resize(rows);
  return run;
}

bool has_parts(const domain::Dataset& data) {
  return data.runs.size() == 1 && data.runs.front().rows() >= parts * least_rows;
}

domain::Dataset in_parts(domain::Dataset data) {
  if (!has_parts(data)) return data;
  const domain::Run whole = std::move(data.runs.front());
  data.runs.clear();
  data.parts_of_a_run = true;
  const std::size_t rows = whole.rows();
  for (std::size_t part = 0; part < parts; ++part) {
    domain::Run run = beginning_of(whole, rows * (part + 1) / parts);
    run.id += "-" + std::to_string(part + 1);
    const auto first = static_cast<std::ptrdiff_t>(rows * part / parts);
    for (domain::Reading& reading : run.readings) {
      reading.missing.resize(run.rows(), false);
      std::fill_n(reading.missing.begin(), first, true);
    }
    data.runs.push_back(std::move(run));
  }
  return data;
}

bool are_settled_points(const domain::Dataset& data) {
  return std::ranges::all_of(
      data.runs, [](const domain::Run& run) { return run.measured && run.measured->point_s > 0.0; });
}

bool are_branches(const domain::Dataset& data) {
  if (!are_settled_points(data)) return false;
  bool up = false, down = false;
  for (const domain::Run& run : data.runs) {
    const auto& columns = run.measured->columns;
    const auto drive = std::ranges::find_if(columns, &domain::MeasuredColumn::given);
    if (drive == columns.end()) return false;
    const bool rises = std::ranges::is_sorted(drive->values),
               falls = std::ranges::is_sorted(drive->values, std::greater());
    if (rises == falls) return false;
    up = up || rises;
    down = down || falls;
  }
  return up && down;
}

bool have_own_lengths(const domain::Dataset& data) {
  std::set<double> lengths;
  for (const domain::Run& run : data.runs) {
    if (!run.measured || !run.measured->gives_length()) return false;
    const std::vector<double>& length = run.measured->given("contraction");
    const auto [least, most] = std::ranges::minmax(length);
    if (least != most || !lengths.insert(least).second) return false;
  }
  return lengths.size() > 1;
}

}  // namespace mckibben::data
