// The gains that a PID of a pair leaves open, tuned on all targets of its scenario with one load in the hand,
// as those of one muscle are (tune_pid.hpp).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <sim/domain/pair_scenario.hpp>
#include <sim/run/simulate.hpp>
#include <sim/run/tune_pid.hpp>

namespace mckibben::run {

struct TunedPair {
  std::string controller;
  double load_kg = 0.0;
  Tuned tuned{};          ///< its proportional gain in mA for a whole contraction ratio of muscle 1
  std::string failure{};  ///< why no gains were found; empty if they were
};

/// What is simulated with a load in the hand, and what a controller is told of a target.
RunPlan plan_of(const domain::PairScenario& scenario, double load_kg);
controllers::Knowledge knowledge_of(const domain::PairScenario& scenario, const domain::JointTarget& target);

/// Angle [rad] of a joint for a whole contraction ratio of muscle 1.
double rad_per_ratio(const plant::Rig& rig);

/// Tunes each of `settings` that leaves gains open and fills them in, on `threads` threads (0: all the
/// machine has). `tried` hears of each trial. Throws Interrupted.
std::vector<TunedPair> tune_pair(const domain::PairScenario& scenario,
                                 std::vector<controllers::PairSettings>& settings, unsigned threads,
                                 const std::function<void()>& tried);

}  // namespace mckibben::run
