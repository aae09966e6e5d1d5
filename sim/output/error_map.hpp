// Error maps as a CSV file, as a table for people, as JSON, and as pictures, one a load.
#pragma once

#include <string>
#include <vector>

#include <sim/input/diagnostics.hpp>
#include <sim/run/error_map.hpp>

namespace mckibben::output {

/// A row for each target of each load and branch; empty cells where there was no run.
std::string csv_of(const run::ErrorMaps& maps);

/// Weighed loads, and rms errors within and beyond what the rig can reach.
std::string table_of(const run::MapPlan& plan, const run::ErrorMaps& maps);

/// The text of map.json: the same numbers, targets, limits of each load, resolved rig, hashes of the files
/// read.
std::string json_of(const run::MapPlan& plan, const run::ErrorMaps& maps,
                    const std::vector<domain::InputFile>& files);

/// What its numbers are: contraction ratios and 1/s, or height of the load in mm and mm/s.
enum class MapUnit { ratio, mm };

/// One load's maps, `load` being one of the plan's that has some: up and down beside each other, errors of
/// contraction ratio above those of speed, with the border of what the rig can reach.
std::string heat_map_svg(const run::MapPlan& plan, const run::ErrorMaps& maps, const run::LoadMap& load,
                         MapUnit unit = MapUnit::ratio);

}  // namespace mckibben::output
