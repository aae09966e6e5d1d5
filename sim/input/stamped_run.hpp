// Measured runs with a clock of their own: which columns they are made of, and what must be true of them.
#pragma once

#include <vector>

#include <sim/domain/combination.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/table.hpp>

namespace mckibben::input {

/// Whether runs read with this map on this rig have a clock of their own, in place of a row each tick.
bool has_own_clock(const domain::ColumnMap& map, const plant::Rig& rig);

/// What such a run is made of, and whether it drives the rig: then it must be there, in every row.
struct Wish {
  const domain::Quantity* quantity;
  bool drives;
};
std::vector<Wish> stamped_quantities(const domain::ColumnMap& map, const plant::Rig& rig);

/// Columns of commands in a unit that their valve does not take.
std::vector<domain::Contradiction> wrong_command_units(const domain::ColumnMap& map, const plant::Rig& rig);

/// Checks a converted table and makes of it what drove the rig and what was read.
domain::Measurement measurement_of(Table& table, const domain::ColumnMap& map, const plant::Rig& rig,
                                   const domain::Recorded& recorded, TableProblems& problems);

}  // namespace mckibben::input
