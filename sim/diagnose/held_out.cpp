// Splits, variance over long times, comparison; see the header.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <sim/diagnose/held_out.hpp>

namespace mckibben::diagnose {
namespace {

/// Lengths have no runs of their own number each: those nearest the middle of the range first.
void nearest_the_middle(const std::map<double, Runs>& by_length, std::vector<Runs>& inner,
                        const domain::Dataset& data) {
  const double middle = 0.5 * (by_length.begin()->first + by_length.rbegin()->first);
  std::ranges::stable_sort(
      inner, {}, [&](const Runs& runs) { return std::abs(level_of(data.runs[runs.front()]) - middle); });
}

}  // namespace

Eigen::Index segment_rows(const Experiment& experiment) {
  return std::max<Eigen::Index>(1, std::lround(thresholds.scatter.segment_s / experiment.data().row_s()));
}

double level_of(const domain::Run& run) {
  if (!run.length_is_given()) return run.load_kg;
  const auto& lengths = run.measured->given("contraction");
  return std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
}

Runs a_few(const domain::Dataset& data, const Runs& runs, std::size_t most) {
  if (runs.size() <= most) return runs;
  Runs by_load = runs;
  std::stable_sort(by_load.begin(), by_load.end(), [&](std::size_t a, std::size_t b) {
    return level_of(data.runs[a]) < level_of(data.runs[b]);
  });
  Runs few;
  for (std::size_t i = 0; i < most; ++i) few.push_back(by_load[i * runs.size() / most]);
  std::sort(few.begin(), few.end());
  return few;
}

Split split(const domain::Dataset& data, const Runs& usable) {
  std::map<double, Runs> by_load;
  for (const std::size_t run : usable) by_load[level_of(data.runs[run])].push_back(run);
  const HeldOutThresholds& by = thresholds.held_out;
  Split result;
  const auto share = [&](std::size_t runs) {
    return static_cast<double>(runs) / static_cast<double>(usable.size());
  };
  if (by_load.size() >= by.least_loads) {
    // The loads nearest the middle of the range of loads, those with fewest runs first.
    std::vector<Runs> inner;
    for (auto it = std::next(by_load.begin()); it != std::prev(by_load.end()); ++it)
      inner.push_back(it->second);
    if (data.force_is_judged()) nearest_the_middle(by_load, inner, data);
    std::stable_sort(inner.begin(), inner.end(),
                     [](const Runs& a, const Runs& b) { return a.size() < b.size(); });
    for (const Runs& runs : inner) {
      if (!result.held_out.empty() && share(result.held_out.size() + runs.size()) > by.most) continue;
      if (share(result.held_out.size()) >= by.enough) break;
      result.held_out.insert(result.held_out.end(), runs.begin(), runs.end());
    }
  }
  if (result.held_out.empty() || share(result.held_out.size()) > by.most_of_all) {
    const double last = by.last * static_cast<double>(usable.size());
    result.held_out.assign(usable.end() - static_cast<std::ptrdiff_t>(last), usable.end());
  }
  std::sort(result.held_out.begin(), result.held_out.end());
  for (const std::size_t run : usable)
    if (!std::binary_search(result.held_out.begin(), result.held_out.end(), run))
      result.training.push_back(run);
  return result;
}

namespace {

/// Of runs of this length so many say enough.
std::size_t most_asked(const domain::Dataset& data, const Runs& runs) {
  const AskedThresholds& by = thresholds.asked;
  double rows = 0.0;
  for (const std::size_t run : runs) rows += static_cast<double>(data.runs[run].judged().size());
  const double mean_s = rows * data.row_s() / static_cast<double>(runs.size());
  return std::max(by.least_runs, static_cast<std::size_t>(by.enough_s / std::max(mean_s, data.row_s())));
}

}  // namespace

Runs asked(const domain::Dataset& data, const Runs& runs) {
  return runs.empty() ? runs : a_few(data, runs, most_asked(data, runs));
}

Split asked(const domain::Dataset& data, const Split& whole) {
  if (whole.training.empty()) return whole;
  return {asked(data, whole.training), a_few(data, whole.held_out, most_asked(data, whole.training) / 2)};
}

double variance_inflation(const Experiment& experiment, const Eigen::VectorXd& residuals, const Runs& runs) {
  const Eigen::Index lags = segment_rows(experiment);
  double sum = 0.0;
  Eigen::Index rows = 0;
  for (const auto& part : experiment.parts(runs)) {
    const auto r = residuals.segment(part.begin, part.rows);
    sum += r.squaredNorm();
    for (Eigen::Index k = 1; k < std::min(lags, part.rows); ++k) {
      const double weight = 1.0 - static_cast<double>(k) / static_cast<double>(lags);
      sum += 2.0 * weight * r.head(part.rows - k).dot(r.tail(part.rows - k));
    }
    rows += part.rows;
  }
  return std::max(1.0, sum / static_cast<double>(std::max<Eigen::Index>(rows, 1)));
}

double excess(const Eigen::VectorXd& residuals) {
  return residuals.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(residuals.size(), 1)) - 1.0;
}

bool near_floor(const Eigen::VectorXd& residuals) {
  return excess(residuals) + 1.0 <= thresholds.near.mean_square();
}

bool all_near_floor(const Experiment& experiment, const Eigen::VectorXd& residuals, const Runs& runs) {
  const auto parts = experiment.parts(runs);
  return std::all_of(parts.begin(), parts.end(),
                     [&](const auto& part) { return near_floor(residuals.segment(part.begin, part.rows)); });
}

Improvement compare(const Experiment& experiment, const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                    const Runs& runs) {
  const Eigen::Index segment = segment_rows(experiment);
  Improvement result;
  std::vector<double> gains;
  double total = 0.0;
  Eigen::Index begin = 0;
  for (const std::size_t run : runs) {
    const auto rows = static_cast<Eigen::Index>(experiment.rows(run));
    double gained = 0.0;
    for (Eigen::Index at = 0; at < rows; at += segment) {
      const Eigen::Index length = std::min(segment, rows - at);
      gains.push_back(before.segment(begin + at, length).squaredNorm() -
                      after.segment(begin + at, length).squaredNorm());
      gained += gains.back();
    }
    result.better += gained > 0.0 ? 1 : 0;
    ++result.runs;
    total += gained;
    begin += rows;
  }
  const auto n = static_cast<double>(gains.size());
  double scatter = 0.0;
  for (const double gain : gains) scatter += (gain - total / n) * (gain - total / n);
  const double deviation = std::sqrt(scatter * n / std::max(1.0, n - 1.0));
  result.gained = total / static_cast<double>(std::max<Eigen::Index>(before.size(), 1));
  result.share = result.gained / std::max(excess(before), thresholds.improvement.least_gap);
  result.significance = deviation > 0.0 ? total / deviation : 0.0;
  return result;
}

bool convinces(const Improvement& improvement, const ImprovementThresholds& least) {
  // Where the gap sits in a few segments, their scatter is as large as the gain, however certain it is.
  const bool certain =
      improvement.significance >= least.significance || improvement.share >= least.clear_share;
  const double better = least.better * static_cast<double>(improvement.runs);
  return improvement.share >= least.share && improvement.gained >= least.gained && certain &&
         static_cast<double>(improvement.better) > better;
}

}  // namespace mckibben::diagnose
