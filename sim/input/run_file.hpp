// The file of one measured run, in any of the formats that are read: its ending tells which.
#pragma once

#include <cstdint>

#include <sim/input/dataset_file.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

/// Reads the file of `run` and checks it: one row each tick, finite numbers, currents that the DAC can give,
/// contractions that a muscle can. `node` is the run in the data set's file; `together`: bytes of all runs'
/// files.
void read_run_file(const YamlFile& file, const Node& node, const Dataset& dataset, Run& run,
                   std::uintmax_t together, Problems& problems);

}  // namespace mckibben::input
