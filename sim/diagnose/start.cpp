// See the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/data/amount.hpp>
#include <sim/diagnose/start.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

constexpr const StartThresholds& of_start = thresholds.start;

/// How far the load goes in the first readings.
double moved(const std::vector<double>& ratio) {
  const auto end = ratio.begin() + static_cast<std::ptrdiff_t>(std::min(ratio.size(), of_start.first_rows));
  const auto [low, high] = std::minmax_element(ratio.begin(), end);
  return ratio.empty() ? 0.0 : *high - *low;
}

/// Of the first rows, those that count: of a later part of a run none do.
double counted(const domain::Reading& judged, Eigen::Index rows) {
  const auto begin = judged.missing.begin();
  return static_cast<double>(judged.missing.empty() ? rows : std::count(begin, begin + rows, false));
}

}  // namespace

Start look_at_start(const Experiment& experiment, const Rig& corrected, const Runs& runs) {
  Start start;
  const double tick_s = experiment.data().row_s();
  std::size_t longest = 0;
  for (const std::size_t run : runs) longest = std::max(longest, experiment.data().runs[run].rows());
  start.lasting_s =
      std::min(of_start.longest_s, of_start.share_of_run * static_cast<double>(longest) * tick_s);
  const auto first = static_cast<Eigen::Index>(std::lround(start.lasting_s / tick_s));
  const double limit = of_start.counts * data::reading_grain(experiment.data().judged(), corrected) +
                       of_start.jitters * experiment.floor().jitter;
  double early = 0.0, all = 0.0, early_rows = 0.0, all_rows = 0.0;
  const auto simulated = experiment.readings(corrected, runs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t run = runs[i];
    const Readings& readings = simulated[i];
    const Eigen::VectorXd residuals =
        experiment.residuals(readings, run).head(static_cast<Eigen::Index>(readings.judged().size()));
    const Eigen::Index rows = std::min(first, residuals.size());
    const auto& measured = experiment.data().runs[run];
    const double of_early = counted(measured.judged(), rows),
                 of_all = counted(measured.judged(), residuals.size());
    early += residuals.head(rows).squaredNorm() - of_early;
    all += residuals.squaredNorm() - of_all;
    early_rows += of_early;
    all_rows += of_all;
    const auto looked_at = static_cast<Eigen::Index>(of_start.first_rows);
    const bool begins = counted(measured.judged(), std::min(looked_at, residuals.size())) > 0.0;
    if (begins && experiment.data().recorded.start == domain::Start::settled && !measured.length_is_given() &&
        moved(measured.judged().values) > limit + of_start.beyond_model * moved(readings.judged()))
      start.unsettled.push_back(measured.id);
  }
  if (all > 0.0) start.share_of_gap = std::clamp(early / all, 0.0, 1.0);
  if (all_rows > 0.0) start.share_of_time = early_rows / all_rows;
  if (all_rows > 0.0) start.floors_left = std::sqrt((all + all_rows) / all_rows);
  return start;
}

std::string sentence_of(const Start& start, const Gap& gap, domain::Start said) {
  std::string text;
  if (gap.floors_left() <= of_start.explained_floors || !start.suspect()) return text;
  if (start.share_of_gap > of_start.share_of_gap)
    text +=
        fmt::format(" {:.0f} % of what is left lies in the first {:.2g} s of the runs, {:.0f} % of the time.",
                    100.0 * start.share_of_gap, start.lasting_s, 100.0 * start.share_of_time);
  if (said == domain::Start::moving) return text;
  if (start.unsettled.empty())
    text += " Did they begin settled, at rest under their first current?";
  else
    text += fmt::format(" Not settled at the start, since the {} moves from the first reading on: {}.",
                        gap.judged == Judged::angle ? "joint" : "load", fmt::join(start.unsettled, ", "));
  if (gap.judged == Judged::contraction) text += " The data set can say that they did not: start: moving.";
  return text;
}

}  // namespace mckibben::diagnose
