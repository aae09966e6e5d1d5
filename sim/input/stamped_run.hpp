// Measured runs with a clock of their own: which columns they are made of, and what must be true of them.
#pragma once

#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/table.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

/// Whether runs read with this map on this rig have a clock of their own, in place of a row each tick.
bool has_own_clock(const domain::ColumnMap& map, const plant::Rig& rig);

/// What such a run is made of, and whether it drives the rig: then it must be there, in every row.
struct Wish {
  const domain::Quantity* quantity;
  bool drives;
};
std::vector<Wish> stamped_quantities(const domain::ColumnMap& map, const plant::Rig& rig);

/// What contradicts the rig, or itself, in the map of a run; shown where it is said.
void check_roles(const YamlFile& file, const Node& run, const domain::ColumnMap& map, const plant::Rig& rig,
                 Problems& problems);

/// Checks a converted table and makes of it what drove the rig and what was read.
domain::Measurement measurement_of(Table& table, const domain::ColumnMap& map, const plant::Rig& rig,
                                   const domain::Recorded& recorded, TableProblems& problems);

}  // namespace mckibben::input
