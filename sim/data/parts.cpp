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
  if (rows >= run.judged().size()) return run;
  for (auto* column : {&run.current_mA, &run.contraction_ratio, &run.force_N, &run.angle_rad, &run.time_s})
    if (!column->empty()) column->resize(rows);
  for (const domain::Beside which : domain::besides) {
    if (which != domain::Beside::force && run.gauge(which)) run.gauge(which)->resize(rows);
    auto& missing = run.missing_beside[static_cast<std::size_t>(which)];
    if (!missing.empty()) missing.resize(rows);
  }
  if (!run.missing.empty()) run.missing.resize(rows);
  for (auto* driving : {&run.measured, &run.shaken})
    if (*driving) (*driving)->rows.resize(rows);
  return run;
}

bool has_parts(const domain::Dataset& data) {
  return data.runs.size() == 1 && data.runs.front().judged().size() >= parts * least_rows;
}

domain::Dataset in_parts(domain::Dataset data) {
  if (!has_parts(data)) return data;
  const domain::Run whole = std::move(data.runs.front());
  data.runs.clear();
  data.parts_of_a_run = true;
  const std::size_t rows = whole.judged().size();
  for (std::size_t part = 0; part < parts; ++part) {
    domain::Run run = beginning_of(whole, rows * (part + 1) / parts);
    run.id += "-" + std::to_string(part + 1);
    const auto first = static_cast<std::ptrdiff_t>(rows * part / parts);
    run.missing.resize(run.judged().size(), false);
    std::fill_n(run.missing.begin(), first, true);
    for (const domain::Beside which : domain::besides)
      if (run.beside(which) != nullptr) {
        auto& missing = run.missing_beside[static_cast<std::size_t>(which)];
        missing.resize(run.judged().size(), false);
        std::fill_n(missing.begin(), first, true);
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
