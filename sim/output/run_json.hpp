// Results as JSON: the text of run.json, which --json prints as well.
#pragma once

#include <string>

#include <sim/domain/scenario.hpp>
#include <sim/run/compare.hpp>

namespace mckibben::output {

/// Resolved input, versions, seed, tolerance, hashes of the input files, results and solver counts. Holds
/// nothing that differs between two runs of the same input.
std::string json_of(const domain::Scenario& scenario, const run::Comparison& comparison);

}  // namespace mckibben::output
