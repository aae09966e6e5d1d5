// Runs whose recording is at fault: late, drifting, with another zero, from another rig. Each run is compared
// with the floor and with what the other runs say of the rig.
#pragma once

#include <vector>

#include <sim/diagnose/candidate.hpp>
#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/fit.hpp>
#include <sim/diagnose/screen.hpp>

namespace mckibben::diagnose {

/// Sizes: ticks late; the share by which the current is too high, or by how many mA; contraction ratio at the
/// run's end; contraction ratio; counts or contraction ratio from `row` on; the share by which readings are
/// too high; ticks of readings that are gone at `row`; nothing for another rig.
enum class FaultKind {
  late,
  current_scale,
  current_offset,
  drift,
  zero,
  slipped,
  reading_scale,
  rows_lost,
  another_rig
};

struct Fault {
  std::size_t run;
  FaultKind kind;
  double size = 0.0;
  std::size_t row = 0;
  bool common = false;  ///< all runs have it: it is the recorder's, or it is real
  /// Each run has its own, and the load tells its size: what is missing may do that, or who set the zero
  /// anew with each load.
  bool told_by_load = false;
};

/// An effect that may be missing beside faults of a few runs, or one of all runs: with these it comes much
/// closer than any effect does without.
struct Suspicion {
  Score effect{};               ///< without its column
  Runs sound{};                 ///< runs that may be fitted with it
  std::vector<Fault> common{};  ///< to be mended before
};

struct Examined {
  std::vector<Fault> faults{};
  std::vector<Suspicion> suspicions{};  ///< where there are no such faults; first what leaves least of a run
};

/// The faults that take every run near the floor where the rig of `at`, with its free parameters fitted to
/// all `runs`, does not: a few runs' own, or one that all have in common. None if most of the runs disagree
/// with the rig in other ways, or if an effect of `catalogue` does nearly as well; then what of it is to be
/// suspected. Throws engine::NumericalFailure, run::Interrupted.
Examined examine(const Experiment& experiment, const Model& at, const Runs& runs,
                 const std::vector<Candidate>& catalogue);

}  // namespace mckibben::diagnose
