// What must be said beside the figures of a comparison: controllers that stood at a limit of their current,
// tunings that gained nothing. Table, report and warnings take their words from here.
#pragma once

#include <string>
#include <string_view>

#include <plant/rig.hpp>
#include <sim/run/compare.hpp>

namespace mckibben::run {

/// From this share of the time on at a limit, a run says more of the limit than of its controller.
inline constexpr double mostly = 0.5;

/// Share of a run's ticks at the lowest or highest current of its controller, of a pair at an end of what
/// either valve answers to; 0 where it has no limits.
double share_at_limit(const TrackedRun& run);

/// How often a controller stood at a limit, over its runs: "stood at its lowest current, 4 mA, for 7 % of the
/// time (with 8.87 kg for 31 %)". Empty below 1 %.
std::string limit_words(const Comparison& comparison, const plant::Rig& rig, std::string_view controller);

/// That a controller oscillates where its target rests, over its runs: "oscillates where its target rests, by
/// ±7.8 mm (with 8.87 kg)", of several the widest. Empty if it does not.
std::string cycle_words(const Comparison& comparison, const plant::Rig& rig, std::string_view controller);

/// Of controllers whose model is the simulated rig itself, compared with one that has no model: that they
/// know it exactly, and the key to write. Empty if there are none.
std::string knowing_words(const domain::Scenario& scenario);

/// Whether no target was asked for: all commands are given, and the target was left out.
bool follows_nothing(const domain::Scenario& scenario, const Comparison& comparison);

/// From when on errors count: ", from 1 s on", and whether the way from rest to the target counts, which
/// nobody asked for. Empty where they count from the beginning and a run begins at its target.
std::string counted_words(const domain::Scenario& scenario, const Comparison& comparison);

/// The same of one run, with what would help: for a warning. Empty unless it stood there `mostly`.
/// `calibrated`: its controller goes by a calibration.
std::string limit_warning(const TrackedRun& run, const plant::Rig& rig, bool calibrated = false);

/// Of an open loop with a calibration that ends off a resting target by more than a fifth of the target's
/// range: by how much, the likely causes, and the keys to write. Empty if it does not.
std::string missed_warning(const TrackedRun& run, const Wanted& wanted, const controllers::Settings& settings,
                           const plant::Rig& rig);

/// Of a controller with a calibration whose load, weighed or assumed, is further from the real one than
/// weighing may be wrong: with the key to write. Empty if it is not.
std::string load_warning(const TrackedRun& run, const controllers::Settings& settings);

/// Of a controller that follows a reading, or weighs by it, whose zero or scale is wrong in the rig by more
/// than a tenth of the mean absolute error: by how much, and the keys. Empty if it is not.
std::string reading_warning(const TrackedRun& run, const controllers::Settings& settings,
                            const plant::Rig& rig);

/// Of a run that goes round and round where its target rests: amplitude, period, and the keys that would
/// help. Empty if it does not, or if `limit_warning` says that it swings.
std::string cycle_warning(const TrackedRun& run, const Wanted& wanted, const controllers::Settings& settings,
                          const plant::Rig& rig);

/// True if the tuned gains follow the target no better than no feedback at all.
bool gained_nothing(const TunedController& tuned);

/// That it gained nothing, the likely cause, and the key to change. Only if so.
std::string tuning_warning(const TunedController& tuned, const plant::Rig& rig);

/// True if a small error says little for a controller: some run has no result, stood mostly at a limit, or
/// oscillates, which errors do not count before the first move, or its tuning gained nothing.
bool in_doubt(const Comparison& comparison, std::string_view controller);

}  // namespace mckibben::run
