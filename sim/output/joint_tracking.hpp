// How controllers of a pair followed their targets, as JSON and as text.
#pragma once

#include <string>

#include <sim/input/json.hpp>
#include <sim/run/pair_runs.hpp>

namespace mckibben::output {

/// What run.json says of a run that followed a target; angles in rad.
input::Json followed_json(const domain::PairScenario& scenario, const run::PairRun& run);
input::Json tuned_json(const domain::PairScenario& scenario, const run::TunedPair& tuned);

/// A line for each run under a controller, the gains that were tuned, and what controllers found out; empty
/// where there are none. Angles in deg.
std::string tracking_text(const domain::PairScenario& scenario, const run::PairRuns& all);

}  // namespace mckibben::output
