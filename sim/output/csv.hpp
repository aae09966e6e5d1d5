// Recordings as text: one row each tick, shortest digits that read back exactly. CSV has its header on line
// 1; the thesis's own files (T 3.3) have none.
#pragma once

#include <string>
#include <vector>

#include <plant/rig.hpp>
#include <sim/input/dataset.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::output {

/// True values, and what the encoder counted. `target` [contraction ratio] and the gauge are columns where
/// there are any. `per_count` is the contraction ratio of one encoder count.
std::string csv_of(const run::Recording& recording, double per_count, const std::vector<double>& target,
                   bool gauge);

/// What was measured, as a data set's table.
std::string csv_of(const input::Run& measured, double tick_s);

/// The thesis's file: current [mA], contraction ratio, its speed [1/s] and acceleration [1/s2], pressure
/// [bar], separated by blanks. All but the current are calculated: ratio from counts, speed and acceleration
/// from differences of counts over the last tick and the last two, pressure from the current by the valve's
/// line.
std::string thesis_ascii(const run::Recording& recording, const plant::Rig& rig, double load_kg);

}  // namespace mckibben::output
