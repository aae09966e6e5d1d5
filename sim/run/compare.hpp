// The main job: every load of a scenario under every controller, and how well each followed the target.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <sim/domain/scenario.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/metrics.hpp>
#include <sim/run/recording.hpp>
#include <sim/run/robustness.hpp>
#include <sim/run/tune_controller.hpp>
#include <sim/run/unreachable.hpp>

namespace mckibben::run {

/// One load under one controller.
struct TrackedRun {
  double load_kg = 0.0;
  std::string controller;
  Recording recording{};
  Metrics metrics{};
  std::string failure{};      ///< why there is no result; empty if there is one
  Unreachable unreachable{};  ///< what the target asks in vain of a controller that plans its way
  std::optional<controllers::CurrentRange> limits{};  ///< of its current, as the DAC gives them
};

/// One controller over all loads that did not fail; absent if none of its runs ended well.
struct ControllerSpread {
  std::string controller;
  std::optional<Spread> rmse{};
};

struct Comparison {
  std::vector<double> target;  ///< contraction ratio at each tick
  std::vector<TunedController> tuned;
  std::vector<TrackedRun> runs;  ///< loads in order, for each all controllers in order
  std::vector<ControllerSpread> spreads;
  std::vector<RobustRow> robustness{};  ///< as `runs`; empty if no rigs are drawn
  std::vector<std::string> drawn{};     ///< numbers of the rig that were, by path
  bool interrupted = false;             ///< the user stopped it; runs not begun say so in `failure`
  std::vector<std::string> unmet;       ///< criteria of the scenario that are not met, in words
  std::vector<std::string>
      warnings;  ///< targets out of reach and doubtful runs: scenario, load, controllers, why
};

/// Tunes what is to be tuned, runs everything on `threads` threads (0: all the machine has) and measures. The
/// result does not depend on the number of threads. With `sharing`, other processes help, and the result is
/// whole in that one only which is given all runs. Throws Interrupted if stopped while tuning.
Comparison compare(const domain::Scenario& scenario, unsigned threads, const ProgressHook& progress,
                   const Sharing& sharing = {});

}  // namespace mckibben::run
