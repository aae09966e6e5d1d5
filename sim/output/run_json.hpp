// Results as JSON: the run.json of a results folder, and what --json prints.
#pragma once

#include <string>
#include <vector>

#include <sim/input/dataset.hpp>
#include <sim/input/scenario.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/replay.hpp>

namespace mckibben::output {

/// Resolved input, versions, seed, tolerance, hashes of the input files, results and solver counts. Holds
/// nothing that differs between two runs of the same input.
input::Json json_of(const input::Scenario& scenario, const run::Comparison& comparison);
input::Json json_of(const input::Dataset& dataset, const std::vector<run::ReplayedRun>& runs);

/// How every such document begins: its schema, versions, hashes of the input files.
input::Json heading_json(const char* schema, const std::vector<input::InputFile>& files);
input::Json solver_json(const engine::Counters& counters);

/// File name of one run's CSV in the results folder.
std::string csv_name(const run::TrackedRun& run);

}  // namespace mckibben::output
