// The main job: every target of a scenario with every load under every controller, and how well each was
// followed; of a pair also the runs under given currents.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sim/domain/scenario.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/metrics.hpp>
#include <sim/run/recording.hpp>
#include <sim/run/robustness.hpp>
#include <sim/run/track.hpp>
#include <sim/run/tune_controller.hpp>
#include <sim/run/unreachable.hpp>

namespace mckibben::run {

/// One load under one controller, or two muscles under given currents.
struct TrackedRun {
  double load_kg = 0.0;
  std::string controller;  ///< empty under given currents
  Recording recording{};
  Metrics metrics{};
  std::string failure{};      ///< why there is no result; empty if there is one
  Unreachable unreachable{};  ///< what the target asks in vain of the rig, or of a controller that plans
  std::optional<controllers::CurrentRange> limits{};  ///< of its current, as the DAC gives them
  std::string id{};                                   ///< what warnings call it
  std::string name{};                                 ///< of its files, without ending
  std::size_t target = 0;                             ///< which of the comparison's
  std::optional<JointFigures> joint{};                ///< of a pair, if there is a row
  std::optional<LimitCycle> cycle{};                  ///< of a hanging load under a controller

  bool followed() const { return !controller.empty(); }
};

/// One controller over all runs that did not fail; absent if none of its runs ended well.
struct ControllerSpread {
  std::string controller;
  std::optional<Spread> rmse{};
  std::size_t runs = 0, with_result = 0;

  bool partial() const { return with_result < runs; }
};

struct Comparison {
  std::vector<Wanted> targets;
  std::vector<TunedController> tuned;
  std::vector<TrackedRun> runs;  ///< given currents; targets in order, for each loads, for each controllers
  std::vector<ControllerSpread> spreads;
  std::vector<RobustRow> robustness{};  ///< as `runs`; empty if no rigs are drawn
  std::vector<std::string> drawn{};     ///< numbers of the rig that were, by path
  bool interrupted = false;             ///< the user stopped it; runs not begun say so in `failure`
  std::vector<std::string> unmet;       ///< criteria of the scenario that are not met, in words
  std::vector<std::string> unjudged{};  ///< those that cannot be evaluated, as a run has no result
  std::vector<std::string>
      warnings;  ///< targets out of reach and doubtful runs: scenario, load, controllers, why
};

/// One target with one load: its runs, one of each controller, begin at `first` of a comparison's.
struct Task {
  std::size_t target = 0;
  double load_kg = 0.0;
  std::size_t first = 0;
};
std::vector<Task> tasks_of(const domain::Scenario& scenario);

/// Tunes what is to be tuned, runs everything on `threads` threads (0: all the machine has) and measures. The
/// result does not depend on the number of threads. With `sharing`, other processes help, and the result is
/// whole in that one only which is given all runs. Throws Interrupted if stopped while tuning.
Comparison compare(const domain::Scenario& scenario, unsigned threads, const ProgressHook& progress,
                   const Sharing& sharing = {});

}  // namespace mckibben::run
