// See the header.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <sim/thesis/cells.hpp>

namespace mckibben::thesis {
namespace {

/// Means of values that lie within `apart` of the smallest of their group, ascending.
std::vector<double> grouped(std::vector<double> values, double apart) {
  std::sort(values.begin(), values.end());
  std::vector<double> means;
  for (std::size_t i = 0; i < values.size();) {
    double sum = 0.0;
    std::size_t n = 0;
    for (const double first = values[i]; i < values.size() && values[i] <= first * (1.0 + apart); ++i, ++n)
      sum += values[i];
    means.push_back(sum / static_cast<double>(n));
  }
  return means;
}

double nearest(const std::vector<double>& values, double wanted) {
  return *std::min_element(values.begin(), values.end(),
                           [&](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); });
}

void put(std::vector<Cell>& cells, double load_kg, double speed, const Samples& samples) {
  const auto same = [&](const Cell& cell) { return cell.load_kg == load_kg && cell.speed_mA_per_s == speed; };
  auto cell = std::find_if(cells.begin(), cells.end(), same);
  if (cell == cells.end()) cell = cells.insert(cell, {load_kg, speed, {}});
  cell->samples.append(samples);
}

/// The same of several runs is one finding; numbers are those of the first.
void add(std::vector<data::Finding>& list, data::Finding found, std::size_t run) {
  const auto same = std::ranges::find_if(
      list, [&](const data::Finding& one) { return !one.runs.empty() && one.kind == found.kind; });
  if (same != list.end()) return same->runs.push_back(run);
  found.runs.push_back(run);
  list.push_back(std::move(found));
}

}  // namespace

std::string Grid::still_runs(const plant::Valve& valve) const {
  std::size_t still = 0;
  const LeftOut* first = nullptr;
  double largest_mA = 0.0;
  for (const LeftOut& run : left_out) {
    if (!run.still) continue;
    if (++still == 1) first = &run;
    largest_mA = std::max(largest_mA, run.largest_current_mA);
  }
  if (first == nullptr) return "";
  constexpr double nearly = 0.95;  // of the span current: there is hardly more to be had
  return fmt::format(
      "nothing moves enough in {} run{}, the first is {}: {}. What helps: {}", still, still == 1 ? "" : "s",
      first->id, first->why,
      largest_mA < nearly * valve.span_command
          ? in_unit(valve.command_unit,
                    fmt::format("a larger current, up to the valve's {:g} mA", valve.span_command))
          : "lighter loads or slower currents, if loads, rig and encoder are right");
}

Grid make_grid(const domain::Dataset& dataset, const ProcessingOptions& options,
               std::vector<data::Finding> wrong) {
  constexpr double same_speed = 0.02, same_load = 1e-3;
  Grid grid;
  std::vector<ProcessedRun> used;
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const domain::Run& run = dataset.runs[i];
    ProcessedRun processed = process(run, dataset, options);
    for (data::Finding& found : processed.wrong) add(wrong, std::move(found), i);
    if (processed.unusable.empty())
      used.push_back(std::move(processed));
    else
      grid.left_out.push_back({processed.id, processed.unusable, processed.still,
                               *std::max_element(run.current_mA.begin(), run.current_mA.end())});
  }
  if (!wrong.empty()) throw data::UnfitData(dataset, std::move(wrong));
  if (used.empty()) {
    const std::string still = grid.still_runs(dataset.rig.valve);
    refuse(dataset,
           "no run can be used for calibration: " +
               (still.empty() ? fmt::format("{}: {}", grid.left_out.front().id, grid.left_out.front().why)
                              : still));
  }
  for (const ProcessedRun& run : used) {
    grid.loads_kg.push_back(run.load_kg);
    grid.speeds_mA_per_s.push_back(run.current_speed_mA_per_s);
  }
  std::sort(grid.loads_kg.begin(), grid.loads_kg.end());
  grid.loads_kg.erase(std::unique(grid.loads_kg.begin(), grid.loads_kg.end()), grid.loads_kg.end());
  const std::size_t distinct = grid.loads_kg.size();
  grid.loads_kg = grouped(grid.loads_kg, same_load);
  grid.merged_loads = distinct - grid.loads_kg.size();
  grid.speeds_mA_per_s = grouped(grid.speeds_mA_per_s, same_speed);
  for (const ProcessedRun& run : used) {
    grid.dropped += run.dropped;
    for (const Direction direction : directions)
      put(grid.cells[static_cast<std::size_t>(direction)], nearest(grid.loads_kg, run.load_kg),
          nearest(grid.speeds_mA_per_s, run.current_speed_mA_per_s), run.of(direction));
  }
  for (auto& cells : grid.cells)
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
      return a.load_kg != b.load_kg ? a.load_kg < b.load_kg : a.speed_mA_per_s < b.speed_mA_per_s;
    });
  return grid;
}

}  // namespace mckibben::thesis
