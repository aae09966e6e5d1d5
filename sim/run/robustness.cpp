// See the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/domain/rig_number.hpp>
#include <sim/run/draws.hpp>
#include <sim/run/robustness.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

/// Where the load turns within some ticks, each time after it went at least `cycle_way`.
std::vector<std::size_t> turns(std::span<const double> contraction) {
  std::vector<std::size_t> found;
  int direction = 0;
  std::size_t edge = 0;
  for (std::size_t k = 0; k < contraction.size(); ++k) {
    const double way = contraction[k] - contraction[edge];
    if (direction * way > 0.0) {
      edge = k;
    } else if (std::abs(way) >= cycle_way) {
      if (direction != 0) found.push_back(edge);
      direction = way > 0.0 ? 1 : -1;
      edge = k;
    }
  }
  return found;
}

/// By linear interpolation between the ordered values (Hyndman & Fan 1996, type 7).
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto before = static_cast<std::size_t>(at);
  const std::size_t after = std::min(before + 1, sorted.size() - 1);
  return std::lerp(sorted[before], sorted[after], at - static_cast<double>(before));
}

}  // namespace

domain::Variation within_stated(plant::Rig rig) {
  domain::Variation variation;
  for (const auto& [path, deviation] : rig.spreads) {
    const domain::RigNumber number = domain::find_number(rig, path);
    if (number.value == nullptr || !std::isfinite(deviation) || deviation == 0.0) continue;
    domain::Varied varied = domain::Varied::normal(*number.value, deviation);
    varied.path = path;
    varied.unit = number.unit;
    varied.low = std::max(varied.low, number.lowest);
    varied.high = std::min(varied.high, number.highest);
    variation.numbers.push_back(std::move(varied));
  }
  return variation;
}

plant::Rig within_rules(const plant::Rig& described, const domain::Variation& variation,
                        const std::vector<double>& drawn) {
  plant::Rig rig = with_numbers(described, variation, drawn);
  if (domain::broken_rule(rig).empty() || !domain::broken_rule(described).empty()) return rig;
  rig = described;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    double& value = *domain::find_number(rig, variation.numbers[i].path).value;
    double kept = value, broken = value = drawn[i];
    if (domain::broken_rule(rig).empty()) continue;
    for (int halved = 0; halved < std::numeric_limits<double>::digits; ++halved) {
      value = std::midpoint(kept, broken);
      (domain::broken_rule(rig).empty() ? kept : broken) = value;
    }
    value = kept;
  }
  return rig;
}

std::optional<LimitCycle> limit_cycle(const Followed& run) {
  const auto least = static_cast<std::size_t>(std::ceil(cycle_rest_s / run.tick_s));
  for (std::size_t begin = 0; begin < run.target.size();) {
    std::size_t end = begin + 1;
    while (end < run.target.size() && run.target[end] == run.target[begin]) ++end;
    auto at = turns(run.contraction.subspan(begin, end - begin));
    if (end - begin >= least && at.size() >= cycle_turns) {
      at.erase(at.begin(), at.end() - cycle_turns);
      std::array<double, cycle_turns - 1> ways{};
      for (std::size_t k = 0; k < ways.size(); ++k)
        ways[k] = std::abs(run.contraction[begin + at[k + 1]] - run.contraction[begin + at[k]]);
      const double period = 2.0 * static_cast<double>(at.back() - at.front()) / ways.size();  // ticks
      if (static_cast<double>(end - begin - at.back()) <= period && ways.back() >= cycle_stays * ways.front())
        return LimitCycle{.amplitude = 0.5 * std::accumulate(ways.begin(), ways.end(), 0.0) / ways.size(),
                          .period_s = period * run.tick_s,
                          .from_s = static_cast<double>(begin) * run.tick_s};
    }
    begin = end;
  }
  return std::nullopt;
}

std::optional<LimitCycle> limit_cycle(const Recording& recording, const Wanted& wanted, double tick_s) {
  std::vector<double> contraction;
  contraction.reserve(recording.samples.size());
  for (const Sample& sample : recording.samples) contraction.push_back(sample.state.joint.contraction_ratio);
  return limit_cycle(
      {.target = wanted.ratios, .contraction = contraction, .current_mA = {}, .tick_s = tick_s});
}

namespace {

DrawnRun outcome(const domain::Scenario& scenario, const Wanted& target, const Recording& recording,
                 const std::optional<controllers::CurrentRange>& limits) {
  if (!recording.failure.empty()) return {.why = recording.failure};
  const Metrics metrics = metrics_of(scenario, target, recording, limits);
  const double at_limit = metrics.at_lowest_current.value_or(0.0) + metrics.at_highest_current.value_or(0.0);
  return {.ended = true,
          .rmse = metrics.rmse,
          .cycles = limit_cycle(recording, target, scenario.rig.tick_s).has_value(),
          .saturated = at_limit > saturated_share,
          .over_contracted = recording.largest_contraction_ratio > plant::risky_contraction_ratio};
}

}  // namespace

std::vector<DrawnRun> on_drawn_rigs(const domain::Scenario& scenario, const Wanted& target,
                                    const domain::Variation& variation, double load_kg,
                                    const std::optional<controllers::CurrentRange>& limits,
                                    const std::function<std::unique_ptr<controllers::Controller>()>& make,
                                    unsigned threads) {
  std::vector<DrawnRun> drawn(static_cast<std::size_t>(scenario.robustness.rigs));
  std::vector<RunPlan> plans;
  std::vector<std::size_t> of;  // drawn rigs that can be
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    RunPlan plan = plan_of(scenario, load_kg, k + 1);
    plan.rig =
        within_rules(scenario.rig, variation,
                     draws(variation, scenario.seed, scenario.robustness.rigs, static_cast<int>(k) + 1));
    plan.keep_ledger = false;
    if (drawn[k].why = unfit(plan.rig, load_kg); !drawn[k].why.empty()) continue;
    plans.push_back(std::move(plan));
    of.push_back(k);
  }
  simulate_all(
      plans.size(), threads,
      [&](std::size_t i) {
        return Order{plans[i], make()};
      },
      [&](std::size_t i, const Recording& recording) {
        drawn[of[i]] = outcome(scenario, target, recording, limits);
      });
  return drawn;
}

RobustRow summed(double load_kg, const std::string& controller, const std::vector<DrawnRun>& runs) {
  RobustRow row{.load_kg = load_kg, .controller = controller, .rigs = runs.size()};
  std::vector<double> rmse;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const DrawnRun& run = runs[k];
    if (!run.ended && row.why.empty()) row.why = fmt::format("rig {}: {}", k + 1, run.why);
    row.failures += run.failed() ? 1 : 0;
    row.no_result += run.ended ? 0 : 1;
    row.limit_cycles += run.cycles ? 1 : 0;
    row.saturated += run.saturated ? 1 : 0;
    row.over_contracted += run.over_contracted ? 1 : 0;
    if (run.ended) rmse.push_back(run.rmse);
  }
  if (rmse.empty()) return row;
  std::ranges::sort(rmse);
  row.rmse = {quantile(rmse, 0.05), quantile(rmse, 0.5), quantile(rmse, 0.95)};
  return row;
}

}  // namespace mckibben::run
