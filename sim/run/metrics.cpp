// Metrics by their definitions; each walks the run once, the lag once for each shift.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <sim/run/metrics.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::run {
namespace {

constexpr double same_instant_s = 1e-9;
constexpr double least_range =
    1e-4;  // a target that moves less, a fraction of an encoder count, counts as constant

constexpr double least_followed = 0.2;  // of a target's motion; of less there is no delay to speak of

struct Range {
  double low, high;
  double width() const { return high - low; }
};

Range range_of(std::span<const double> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

/// The target moves from one tick to another, from a rest to the next; from tick `next` on it moves again.
struct Motion {
  std::size_t begin, end, next;
  Range range;
};

/// Rests of a single tick are none: a triangle may have the same value on both sides of its tip.
std::vector<Motion> motions_of(std::span<const double> target) {
  std::vector<Motion> all;
  for (std::size_t k = 1; k < target.size(); ++k) {
    if (target[k] == target[k - 1]) continue;
    if (all.empty() || k > all.back().end + 2) {
      if (!all.empty()) all.back().next = k;
      all.push_back({k - 1, k, target.size(), {}});
    }
    all.back().end = k;
  }
  for (Motion& one : all) one.range = range_of(target.subspan(one.begin, one.end - one.begin + 1));
  std::erase_if(all, [](const Motion& one) { return one.range.width() < least_range; });
  return all;
}

double overshoot_of(const Motion& motion, const Followed& run) {
  bool moved_up = false, moved_down = false;
  double largest = 0.0;
  for (std::size_t k = motion.begin + 1; k < motion.next; ++k) {
    moved_up = moved_up || run.target[k] > run.target[k - 1];
    moved_down = moved_down || run.target[k] < run.target[k - 1];
    if (moved_up) largest = std::max(largest, run.contraction[k] - motion.range.high);
    if (moved_down) largest = std::max(largest, motion.range.low - run.contraction[k]);
  }
  return largest / motion.range.width();
}

void check(const Followed& run) {
  if (run.target.empty() || run.target.size() != run.contraction.size() ||
      run.target.size() != run.current_mA.size())
    throw std::invalid_argument("metrics: columns are empty or differ in length");
  if (!(run.tick_s > 0.0)) throw std::invalid_argument("metrics: the tick must be above zero");
}

double mean_square_at_shift(const Followed& run, std::size_t shift) {
  double sum = 0.0;
  for (std::size_t k = 0; k < run.target.size(); ++k) {
    const double error = run.contraction[k] - run.target[k < shift ? 0 : k - shift];
    sum += error * error;
  }
  return sum / static_cast<double>(run.target.size());
}

/// Share of the delayed target's motion that the load made, too (2 a - a^2 of a times that motion).
double followed_at_shift(const Followed& run, std::size_t shift) {
  const auto count = static_cast<double>(run.target.size());
  double error = 0.0, errors = 0.0, moved = 0.0, moves = 0.0;
  for (std::size_t k = 0; k < run.target.size(); ++k) {
    const double target = run.target[k < shift ? 0 : k - shift], from = target - run.target[0],
                 off = run.contraction[k] - target;
    error += off, errors += off * off;
    moved += from, moves += from * from;
  }
  return 1.0 - (errors - error * error / count) / (moves - moved * moved / count);
}

double share_of(std::span<const double> values, const auto& is_one) {
  return static_cast<double>(std::count_if(values.begin(), values.end(), is_one)) /
         static_cast<double>(values.size());
}

/// How often the current comes back to an end from a quarter of the range away.
std::size_t returns_to_an_end(std::span<const double> current_mA, double lowest_mA, double highest_mA) {
  const double far_mA = 0.25 * (highest_mA - lowest_mA);
  std::size_t count = 0;
  std::optional<double> end_mA;
  double farthest_mA = 0.0;
  for (const double i_mA : current_mA) {
    if (end_mA) farthest_mA = std::max(farthest_mA, std::abs(i_mA - *end_mA));
    if (i_mA > lowest_mA && i_mA < highest_mA) continue;
    count += farthest_mA > far_mA ? 1 : 0;
    end_mA = i_mA;
    farthest_mA = 0.0;
  }
  return count;
}

}  // namespace

bool moves_in_steps(std::span<const double> target) {
  const auto motions = motions_of(target);
  return !motions.empty() &&
         std::ranges::all_of(motions, [](const Motion& one) { return one.end == one.begin + 1; });
}

std::optional<double> time_lag_s(const Followed& run) {
  if (range_of(run.target).width() <= 0.0 || range_of(run.contraction).width() <= 0.0) return std::nullopt;
  if (moves_in_steps(run.target)) return std::nullopt;
  const double duration_s = static_cast<double>(run.target.size() - 1) * run.tick_s;
  const auto most = static_cast<std::size_t>(std::min(2.0, 0.25 * duration_s) / run.tick_s + 1e-9);
  std::vector<double> misfit(most + 2);  // one past the limit, so that the parabola has both its neighbours
  for (std::size_t shift = 0; shift < misfit.size(); ++shift)
    misfit[shift] = mean_square_at_shift(run, shift);
  const auto best =
      static_cast<std::size_t>(std::min_element(misfit.begin(), misfit.end() - 1) - misfit.begin());

  if (misfit[most + 1] < misfit[best]) return std::nullopt;  // the least lies outside what was searched
  if (!(followed_at_shift(run, best) > least_followed)) return std::nullopt;
  double between = 0.0;
  if (best > 0) {
    const double before = misfit[best - 1], after = misfit[best + 1];
    const double curvature = before - 2.0 * misfit[best] + after;
    if (curvature > 0.0) between = std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
  }
  return (static_cast<double>(best) + between) * run.tick_s;
}

std::optional<double> overshoot(const Followed& run) {
  std::optional<double> largest;
  for (const Motion& motion : motions_of(run.target))
    largest = std::max(largest.value_or(0.0), overshoot_of(motion, run));
  return largest;
}

std::optional<double> settling_time_s(const Followed& run) {
  const auto motions = motions_of(run.target);
  const double end_s = static_cast<double>(run.target.size() - 1) * run.tick_s;
  if (!run.last_change_s || motions.empty() || end_s < *run.last_change_s - same_instant_s)
    return std::nullopt;
  double longest_s = 0.0;
  for (const Motion& motion : motions) {
    const double band = 0.02 * motion.range.width();
    std::size_t settled = motion.next;  // first tick of the unbroken stretch within the band at the end
    while (settled > motion.begin && std::abs(run.contraction[settled - 1] - run.target[settled - 1]) <= band)
      --settled;
    if (settled == motion.next) return std::nullopt;
    const bool last = motion.next == run.target.size();  // its end is known between ticks
    const double from_s = last ? *run.last_change_s : static_cast<double>(motion.end) * run.tick_s;
    longest_s = std::max(longest_s, tidy_s(static_cast<double>(settled) * run.tick_s - from_s));
  }
  return longest_s;
}

Metrics measure(const Followed& run) {
  check(run);
  Metrics metrics;
  const auto ticks = run.target.size();
  for (std::size_t k = 0; k < ticks; ++k) {
    const double error = run.contraction[k] - run.target[k];
    metrics.rmse += error * error;
    metrics.mae += std::abs(error);
    metrics.largest_error = std::max(metrics.largest_error, std::abs(error));
    if (k > 0) metrics.current_travel_mA += std::abs(run.current_mA[k] - run.current_mA[k - 1]);
  }
  metrics.rmse = std::sqrt(metrics.rmse / static_cast<double>(ticks));
  metrics.mae /= static_cast<double>(ticks);
  metrics.final_error = run.contraction.back() - run.target.back();
  metrics.time_lag_s = time_lag_s(run);
  metrics.overshoot = overshoot(run);
  metrics.settling_time_s = settling_time_s(run);
  metrics.air_kg = run.air_kg;
  if (run.limits) {
    constexpr double rounding_mA = 1e-9;
    const double lowest_mA = run.limits->lowest_mA, highest_mA = run.limits->highest_mA;
    metrics.at_lowest_current =
        share_of(run.current_mA, [&](double i_mA) { return i_mA <= lowest_mA + rounding_mA; });
    metrics.at_highest_current =
        share_of(run.current_mA, [&](double i_mA) { return i_mA >= highest_mA - rounding_mA; });
    metrics.swings = static_cast<double>(returns_to_an_end(run.current_mA, lowest_mA + rounding_mA,
                                                           highest_mA - rounding_mA)) >
                     static_cast<double>(ticks) * run.tick_s;
  }
  return metrics;
}

Spread spread(std::span<const double> values) {
  if (values.empty()) throw std::invalid_argument("spread: no values");
  const auto count = static_cast<double>(values.size());
  const Range range = range_of(values);
  Spread spread{range.low, range.high, 0.0, 0.0};
  for (const double value : values) spread.mean += value / count;
  double squares = 0.0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  if (values.size() > 1) spread.standard_deviation = std::sqrt(squares / (count - 1.0));
  return spread;
}

}  // namespace mckibben::run
