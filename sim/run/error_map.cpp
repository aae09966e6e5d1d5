// Weighing first, then one run a target; see the header.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <controllers/open_loop.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/error_map.hpp>
#include <sim/run/reachable.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

using controllers::Branch, controllers::value_of;

// A current that creeps for longer is no triangle that anybody waits for (extrapolation can ask for one).
constexpr double longest_s = 600.0;

class Mapping {
 public:
  Mapping(const MapPlan& plan, unsigned threads, const ProgressHook& progress)
      : plan_(plan), threads_(threads), progress_(progress), knowledge_(knowledge_of(plan.rig, {})) {}

  ErrorMaps operator()() {
    maps_.reach = reachable(plan_.rig);
    for (const double load_kg : plan_.loads_kg)
      maps_.loads.push_back({.load_kg = load_kg, .limits = maps_.reach.at_load(load_kg)});
    weigh_all();
    std::vector<Job> jobs;
    for (auto& load : maps_.loads) {
      if (!load.failure.empty()) continue;
      for (const Branch branch : plan_.branches) load.branches.push_back(targets(load, branch));
      for (auto& map : load.branches)
        for (auto& cell : map.cells)
          if (auto job = job_of(load, map.branch, cell)) jobs.push_back(*std::move(job));
    }
    try {
      each(
          "simulating", jobs.size(),
          [&](std::size_t i) { return order(jobs[i].load_kg, jobs[i].ticks_before + 2, jobs[i].how); },
          [&](std::size_t i, const Recording& recording) { judge(jobs[i], recording); });
    } catch (const Interrupted&) {
      maps_.interrupted = true;
    }
    return std::move(maps_);
  }

 private:
  /// A target's run.
  struct Job {
    double load_kg;
    Branch branch;
    MapCell* cell;
    controllers::OpenLoopSettings how;
    std::size_t ticks_before;  ///< whole ones, before it should be there
    double share;              ///< of the tick in which it should
  };

  void each(const std::string& what, std::size_t count, const Ordering& ordering,
            const std::function<void(std::size_t, const Recording&)>& finished) {
    std::atomic<std::size_t> done{0};
    progress_(what, 0, count);
    simulate_all(count, threads_, ordering, [&](std::size_t i, const Recording& recording) {
      finished(i, recording);
      progress_(what, ++done, count);
    });
  }

  controllers::OpenLoopSettings settings() const {
    controllers::OpenLoopSettings settings;
    settings.model = plan_.calibration;
    settings.extrapolate_load = plan_.extrapolate_load;
    settings.extrapolate_target = plan_.extrapolate_target;
    return settings;
  }

  Order order(double load_kg, std::size_t ticks, const controllers::OpenLoopSettings& how) const {
    return {{.rig = plan_.rig, .load_kg = load_kg, .ticks = ticks}, how.make(knowledge_)};
  }

  void weigh_all() {
    each(
        "weighing", maps_.loads.size(),
        [&](std::size_t i) { return order(maps_.loads[i].load_kg, 1, settings()); },
        [&](std::size_t i, const Recording& recording) {
          LoadMap& load = maps_.loads[i];
          load.failure = recording.failure;
          load.weighed_kg = value_of(recording.findings, "weighed_load");
          load.spread_kg = value_of(recording.findings, "weighed_load_spread");
          load.believed_kg = value_of(recording.findings, "believed_load");
          load.extrapolated = value_of(recording.findings, "load_extrapolated") != 0.0;
        });
  }

  BranchMap targets(const LoadMap& load, Branch branch) const {
    BranchMap map{branch, {}};
    for (const double speed_per_s : plan_.speeds_per_s)
      for (const double ratio : plan_.ratios)
        map.cells.push_back({.ratio = ratio,
                             .speed_per_s = speed_per_s,
                             .reachable = within_reach(maps_.reach, load.limits, branch, ratio, speed_per_s),
                             .failure = not_begun});
    return map;
  }

  /// None for a cell whose current would take too long; it says so.
  std::optional<Job> job_of(const LoadMap& load, Branch branch, MapCell& cell) const {
    controllers::OpenLoopSettings how = settings();
    how.assumed_load_kg = load.believed_kg;
    how.mode = controllers::OpenLoopMode::triangle;
    how.to = {cell.ratio, false};
    how.speed_per_s = sign(branch) * cell.speed_per_s;

    const controllers::Inverse inverse(plan_.calibration, *how.assumed_load_kg, knowledge_.valve,
                                       plan_.extrapolate_target);
    cell.asked = inverse(branch, cell.ratio, how.speed_per_s);
    cell.off_the_line = cell.asked.pressure_Pa < knowledge_.valve.zero_pressure_Pa ||
                        cell.asked.pressure_Pa > knowledge_.valve.span_pressure_Pa;

    const auto plans = how.make(knowledge_);
    plans->rest();
    const double at_s = value_of(plans->findings(), "arrival");
    if (!(at_s <= longest_s)) {
      cell.failure = fmt::format("its current takes {:.3g} s, more than {:g} s", at_s, longest_s);
      return std::nullopt;
    }
    const double at_ticks = at_s / plan_.rig.tick_s;
    const auto before = static_cast<std::size_t>(at_ticks);
    return Job{load.load_kg, branch, &cell, how, before, at_ticks - static_cast<double>(before)};
  }

  static void judge(const Job& job, const Recording& recording) {
    MapCell& cell = *job.cell;
    cell.failure = recording.failure;
    if (!cell.failure.empty()) return;
    const auto &a = recording.samples[job.ticks_before].state.joint,
               &b = recording.samples[job.ticks_before + 1].state.joint;
    cell.arrival = {
        std::lerp(a.contraction_ratio, b.contraction_ratio, job.share),
        sign(job.branch) * std::lerp(a.contraction_speed_per_s, b.contraction_speed_per_s, job.share)};
  }

  static double sign(Branch branch) { return branch == Branch::contraction ? 1.0 : -1.0; }

  const MapPlan& plan_;
  unsigned threads_;
  const ProgressHook& progress_;
  controllers::Knowledge knowledge_;
  ErrorMaps maps_{};
};

}  // namespace

MapError error_over(const BranchMap& map, const std::function<bool(const MapCell&)>& chosen) {
  MapError error;
  for (const auto& cell : map.cells) {
    if (!cell.arrival || !chosen(cell)) continue;
    ++error.cells;
    error.ratio += std::pow(cell.ratio_error(), 2);
    error.speed_per_s += std::pow(cell.speed_error_per_s(), 2);
  }
  const auto n = static_cast<double>(std::max<std::size_t>(error.cells, 1));
  error.ratio = std::sqrt(error.ratio / n);
  error.speed_per_s = std::sqrt(error.speed_per_s / n);
  return error;
}

bool covers(const controllers::CalibratedRange& range, double load_kg) {
  constexpr double rounding = 1e-9;
  return load_kg >= range.lowest_load_kg * (1.0 - rounding) &&
         load_kg <= range.highest_load_kg * (1.0 + rounding);
}

bool within_reach(const controllers::Reach& reach, const controllers::ReachOfLoad& limits, Branch branch,
                  double ratio, double speed_per_s) {
  const bool up = branch == Branch::contraction;
  return ratio >= (up ? limits.lowest_rising : limits.lowest_falling) && ratio <= limits.highest &&
         speed_per_s <= reach.at_ratio(up ? limits.rising_per_s : limits.falling_per_s, ratio);
}

ErrorMaps error_maps(const MapPlan& plan, unsigned threads, const ProgressHook& progress) {
  return Mapping(plan, threads, progress)();
}

}  // namespace mckibben::run
