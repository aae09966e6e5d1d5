// Tables of rides that followed stamps: a row each, only columns of what there is. A pair's are named by
// muscle.
#pragma once

#include <vector>

#include <sim/domain/rig_file.hpp>
#include <sim/formats/table.hpp>
#include <sim/run/pair_runs.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::output {

/// `force`: a column for the cord's force, though nothing holds the muscle.
std::vector<formats::Column> driven_columns(const run::Recording& recording, const domain::RigFile& rig,
                                            bool force);

/// What was measured of a pair: currents, the angle as counted, pressures if the rig has gauges.
std::vector<formats::Column> measured_pair_columns(const run::Recording& recording,
                                                   const domain::RigFile& rig);

/// Of a run of a pair, and what was wanted of it.
std::vector<formats::Column> pair_columns(const run::PairRun& run, const domain::RigFile& rig);

}  // namespace mckibben::output
