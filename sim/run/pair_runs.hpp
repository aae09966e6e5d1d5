// Two muscles under given currents, run by run.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/pair_scenario.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/follow.hpp>

namespace mckibben::run {

/// Lowest and highest of what a run came through.
struct Span {
  double low = 0.0, high = 0.0;
};

struct PairRun {
  std::string name;
  Recording recording{};
  Span angle_rad{}, cord_force_N{}, opposite_cord_force_N{};
  std::string failure{};  ///< why it ends early; empty if it did not
};

/// Simulates every run. Of runs that were not begun when the user stopped, `failure` says so (`not_begun`).
std::vector<PairRun> run_pairs(const domain::PairScenario& scenario, unsigned threads,
                               const ProgressHook& progress);

/// What should not be believed of the runs, and which contract too far (T 2.3), in words.
std::vector<std::string> warnings_of(const std::vector<PairRun>& runs);

}  // namespace mckibben::run
