// Results as JSON: the run.json of a results folder, and what --json prints.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/domain/scenario.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/replay.hpp>

namespace mckibben::output {

/// Resolved input, versions, seed, tolerance, hashes of the input files, results and solver counts. Holds
/// nothing that differs between two runs of the same input.
input::Json json_of(const domain::Scenario& scenario, const run::Comparison& comparison);
input::Json json_of(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs);

/// How every such document begins: its schema, versions, hashes of the input files.
input::Json heading_json(const char* schema, const std::vector<domain::InputFile>& files);
/// Where air and work went in a run.
input::Json ledger_json(const plant::Rig& rig, const run::Recording& recording);
input::Json solver_json(const engine::Counters& counters);

/// Name of one run's files in the results folder, without ending.
std::string file_stem(const run::TrackedRun& run);

}  // namespace mckibben::output
