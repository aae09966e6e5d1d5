// Results of rides that followed stamps, as JSON and as text: pairs under given currents, and replays of data
// with a clock of their own.
#pragma once

#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/run/gaps.hpp>
#include <sim/run/pair_runs.hpp>

namespace mckibben::output {

/// The run.json of a results folder, and what --json prints. Holds nothing that differs between two runs of
/// the same input.
input::Json json_of(const domain::PairScenario& scenario, const std::vector<run::PairRun>& runs,
                    const std::vector<std::string>& warnings);
input::Json json_of(const domain::Dataset& dataset, const std::vector<run::StampedRun>& runs,
                    const std::vector<std::string>& warnings);

/// What is printed, and table.txt.
std::string table_of(const domain::PairScenario& scenario, const std::vector<run::PairRun>& runs,
                     const std::vector<std::string>& warnings);
std::string table_of(const domain::Dataset& dataset, const std::vector<run::StampedRun>& runs,
                     const std::vector<std::string>& warnings);

/// A gap's numbers with as many digits as it deserves.
std::string gap_number(double value, bool sign = false);

}  // namespace mckibben::output
