// Readings of a measured run beside their simulation, whatever was read: how far one is from the other.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::run {

/// Simulated less measured, over the rows that are judged and in which there is a reading.
struct Gap {
  std::string reading;  ///< contraction, angle, force, muscle_pressure; of a pair muscle_pressure_1, ..._2
  std::string unit;     ///< 1, rad or deg, N, bar
  double rmse = 0.0, largest = 0.0, mean = 0.0;
  std::size_t rows = 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;  ///< of what was measured
};

/// What a sensor would show of a signal in a run, from a row of its simulation; `counted`: in whole counts.
using Shown = std::function<double(const Sample& row)>;
Shown shown_of(const plant::Channel& channel, const domain::Run& run, const plant::Rig& rig, bool counted);

/// Each reading beside its simulation at a row of the recording, in the unit of its gap; NaN where there is
/// no reading. What was counted is compared with counts, all else with what a sensor would show.
struct Compared {
  std::string reading, unit;
  std::function<double(std::size_t k)> measured, simulated;
};
/// What models are judged by comes first. Refers to `run` and `recording`.
std::vector<Compared> compared(const domain::Run& run, const plant::Rig& rig, const Recording& recording);
std::vector<Gap> gaps_of(const domain::Run& run, const plant::Rig& rig, const Recording& recording);

}  // namespace mckibben::run
