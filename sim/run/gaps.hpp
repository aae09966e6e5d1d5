// A measured run with a clock of its own: what drove it, for a ride to follow, and how far the simulation is
// from each reading.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/follow.hpp>

namespace mckibben::run {

/// Simulated less measured, over the rows that are judged and in which there is a reading.
struct Gap {
  std::string reading;  ///< contraction, angle, force, muscle_pressure; of a pair muscle_pressure_1, ..._2
  std::string unit;     ///< 1, rad or deg, N, bar
  double rmse = 0.0, largest = 0.0, mean = 0.0;
  std::size_t rows = 0;
};

/// One for each reading that there is. What was counted is compared with counts, all else with true values.
std::vector<Gap> gaps_of(const domain::Measurement& measured, const domain::RigFile& rig,
                         const Recording& recording);

/// Each reading beside its simulation, in the unit of its gap.
struct Compared {
  std::string reading, unit;
  std::function<double(std::size_t k)> measured, simulated;
};
/// Refers to `measured` and `recording`.
std::vector<Compared> compared(const domain::Measurement& measured, const domain::RigFile& rig,
                               const Recording& recording);

/// A measured run and its simulation.
struct StampedRun {
  std::string id;
  double load_kg = 0.0;  ///< where one hangs
  Recording recording{};
  std::vector<Gap> gaps{};
  std::string failure{};  ///< why the integrator gave up; empty if it did not
};

/// Simulates every run of a data set with a clock of its own. Of runs that were not begun when the user
/// stopped, `failure` says so (`not_begun`).
std::vector<StampedRun> replay_stamped(const domain::Dataset& dataset, unsigned threads,
                                       const ProgressHook& progress);

/// Joint angle [rad] of a pair in a row, true and as the encoder counts it.
double angle_rad(const domain::RigFile& rig, const Sample& row);
double counted_angle_rad(const domain::RigFile& rig, const Sample& row);

}  // namespace mckibben::run
