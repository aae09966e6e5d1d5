// How a controller does on rigs that are not quite as they are described: rigs drawn within what the rig's
// file says of its numbers (`±`), the controller told what it is told of the described one. Error bands in
// place of single numbers; what nobody would want of a bench counts as a failure.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <sim/domain/scenario.hpp>
#include <sim/domain/variation.hpp>
#include <sim/run/metrics.hpp>
#include <sim/run/track.hpp>

namespace mckibben::run {

/// A run counts as a limit cycle if the load turns round at least so often, each time after a way of so much
/// [contraction ratio], while the target rests for so long; if it still does in the last period of that rest;
/// and if the last of the ways between these turns is at least such a share of the first: others die away.
inline constexpr std::size_t cycle_turns = 4;
inline constexpr double cycle_way = 1e-3, cycle_rest_s = 1.0, cycle_stays = 0.7;
/// As saturated, if its current stood at an end of its range for more than this share of the time.
inline constexpr double saturated_share = 0.10;

/// Of one drawn rig.
struct DrawnRun {
  bool ended = false;  ///< false: the controller or the integrator gave up, or the rig cannot be
  std::string why{};   ///< it did not
  double rmse = 0.0;
  bool cycles = false, saturated = false, over_contracted = false;
  bool failed() const { return !ended || cycles || saturated || over_contracted; }
};

/// Of the rmse of those that came to their end: 5 %, 50 % and 95 % of them lie below.
struct Band {
  double low = 0.0, median = 0.0, high = 0.0;
};

/// One load under one controller, on all drawn rigs.
struct RobustRow {
  double load_kg = 0.0;
  std::string controller;
  std::size_t rigs = 0, failures = 0;  ///< failures: rigs with at least one of these
  std::size_t no_result = 0, limit_cycles = 0, saturated = 0, over_contracted = 0;
  std::optional<Band> rmse{};
  std::string why{};  ///< the first of those without a result has none; empty if all have one
};

/// What is drawn of a rig, by the deviations that its file states; cut at the documented range. Numbers that
/// are not known at all are none of them.
domain::Variation within_stated(plant::Rig rig);

/// The rig with what was drawn, as far as the rules between its numbers allow: where the draws break one,
/// each in turn goes only so far from the described rig that none is broken.
plant::Rig within_rules(const plant::Rig& described, const domain::Variation& variation,
                        const std::vector<double>& drawn);

/// How a load goes round and round where its target rests; none if it comes to rest.
struct LimitCycle {
  double amplitude, period_s;  ///< means; of contraction ratio, half of the way between two turns
  double from_s;               ///< since when the target rests there
};
std::optional<LimitCycle> limit_cycle(const Followed& run);
std::optional<LimitCycle> limit_cycle(const Recording& recording, const Wanted& wanted, double tick_s);

/// One load under the controllers that `make` makes, on each of the scenario's drawn rigs. What is drawn
/// depends on the scenario's seed and on nothing else: all controllers meet the same rigs, and the same noise
/// on each. Throws Interrupted.
std::vector<DrawnRun> on_drawn_rigs(const domain::Scenario& scenario, const Wanted& target,
                                    const domain::Variation& variation, double load_kg,
                                    const std::optional<controllers::CurrentRange>& limits,
                                    const std::function<std::unique_ptr<controllers::Controller>()>& make,
                                    unsigned threads);

RobustRow summed(double load_kg, const std::string& controller, const std::vector<DrawnRun>& runs);

}  // namespace mckibben::run
