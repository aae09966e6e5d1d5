// Error maps as a CSV file, as a table for people, as JSON.
#pragma once

#include <string>
#include <vector>

#include <sim/input/diagnostics.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/run/error_map.hpp>

namespace mckibben::output {

/// A row for each target of each load and branch; empty cells where there was no run.
std::string csv_of(const run::ErrorMaps& maps);

/// Weighed loads, and rms errors within and beyond what the rig can reach.
std::string table_of(const run::MapPlan& plan, const run::ErrorMaps& maps);

/// The same numbers, targets, limits of each load, resolved rig, hashes of the files read.
input::Json json_of(const run::MapPlan& plan, const run::ErrorMaps& maps,
                    const std::vector<domain::InputFile>& files);

}  // namespace mckibben::output
