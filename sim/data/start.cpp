// See the header.
#include <algorithm>
#include <cmath>
#include <ranges>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <sim/data/amount.hpp>
#include <sim/data/series.hpp>
#include <sim/data/start.hpp>
#include <sim/data/thresholds.hpp>

namespace mckibben::data {
namespace {

constexpr const StartThresholds& of_starts = thresholds.start;

/// A row.
double slope(std::span<const double> values) {
  std::vector<double> rows;
  for (std::size_t k = 0; k < values.size(); ++k) rows.push_back(static_cast<double>(k));
  return Line(values, rows).slope;
}

/// Of the first rows; nothing if the run is at rest there, or the rig moves as well.
std::optional<double> speed_at_first(const domain::Dataset& data, const domain::Run& run,
                                     const std::vector<double>& model) {
  const double row_s = data.row_s();
  const std::size_t rows =
      std::max(of_starts.least_rows, static_cast<std::size_t>(std::ceil(of_starts.look_s / row_s)));
  const std::vector<double>& read = run.judged().values;
  if (read.size() != model.size() || read.size() < rows) return std::nullopt;
  if (std::ranges::count(run.judged().missing | std::views::take(rows), true) > 0) return std::nullopt;
  const std::span first(read.data(), rows);
  const double all = slope(first), at_once = slope(first.first(rows / 2)), rig = slope({model.data(), rows});
  const double grain = reading_grain(data.judged(), data.rig);
  if (std::abs(all) * static_cast<double>(rows) < of_starts.moving_counts * grain) return std::nullopt;
  if (at_once / all < of_starts.at_once || rig / all > of_starts.rig_moves) return std::nullopt;
  return all / row_s;
}

}  // namespace

std::optional<Finding> begins_moving(const domain::Dataset& data, const std::vector<Expected>& expected) {
  const domain::Judged judged = data.judged();
  const bool position = judged == domain::Judged::contraction || judged == domain::Judged::angle;
  if (data.recorded.start != domain::Start::settled || data.recorded.skip_s > 0.0 || !position)
    return std::nullopt;
  std::vector<std::size_t> runs;
  double fastest = 0.0;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const domain::Run& run = data.runs[i];
    if (run.length_is_given() || (run.measured && run.measured->point_s > 0.0)) continue;
    const auto speed = speed_at_first(data, run, expected[i].judged());
    if (!speed) continue;
    if (std::abs(*speed) > std::abs(fastest)) {
      fastest = *speed;
      runs.insert(runs.begin(), i);
    } else {
      runs.push_back(i);
    }
  }
  if (runs.empty()) return std::nullopt;
  const std::string id = data.runs[runs.front()].id;
  std::ranges::sort(runs);
  return Finding{
      .runs = std::move(runs),
      .message = fmt::format("begins on its way, {} at {}/s: start: settled says at rest. Where rows "
                             "before were cut off, write start: moving at the top of dataset.yaml",
                             id, amount_of(judged, fastest, data.rig)),
      .severity = Severity::doubtful};
}

}  // namespace mckibben::data
