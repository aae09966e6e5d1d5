// What a scenario of a pair asks for, run by run: under given currents, and every target with every load in
// the hand under every controller.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sim/domain/pair_scenario.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/tune_pair.hpp>

namespace mckibben::run {

/// What a controller was asked for, and what came of it.
struct JointFollowed {
  std::size_t target = 0, controller = 0;     ///< which of the scenario's
  double load_kg = 0.0;                       ///< in the hand
  std::vector<double> angle_rad;              ///< wanted at each tick
  std::vector<double> stiffness_N_m_per_rad;  ///< wanted at each tick; empty if none is
  Metrics metrics{};                          ///< of the angle; lengths of the target in rad
  /// Means over the run, and the root mean square of what the stiffness missed.
  std::optional<double> stiffness_asked{}, stiffness_rmse{};
  double stiffness_had = 0.0;
  double at_limit =
      0.0;  ///< share of the ticks at which some current is at an end of what its valve answers to
};

struct PairRun {
  std::string name;
  Recording recording{};
  Span angle_rad{}, cord_force_N{}, opposite_cord_force_N{};
  std::string failure{};                    ///< why it ends early; empty if it did not
  std::optional<JointFollowed> followed{};  ///< none under given currents
};

struct PairRuns {
  std::vector<TunedPair> tuned;
  std::vector<PairRun> runs;  ///< under currents; then targets in order, for each loads, for each controllers
};

/// Tunes what is to be tuned and simulates every run. Of runs that were not begun when the user stopped,
/// `failure` says so (`not_begun`). Throws Interrupted if stopped while tuning.
PairRuns run_pairs(const domain::PairScenario& scenario, unsigned threads, const ProgressHook& progress);

/// What should not be believed of the runs, in words.
std::vector<std::string> warnings_of(const std::vector<PairRun>& runs);

}  // namespace mckibben::run
