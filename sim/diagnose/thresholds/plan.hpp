// Thresholds of stage 7, plan: what is told of the start of runs, and the next measurement.
#pragma once

#include <array>
#include <cstddef>

namespace mckibben::diagnose {

/// What is told of the start of runs, and of the end of the search.
struct StartThresholds {
  /// Memories of effects in runs that began on their way, in their working sizes, from where they would rest.
  double memory = 0.5;            ///< so far off they may be
  double memory_step = 0.01;      ///< for a slope
  double memory_near = 0.01;      ///< a straight line from so near is good enough,
  int flights = 3;                ///< or after so many
  double explained_floors = 2.0;  ///< rms: more is something to explain
  double longest_s = 4.0;         ///< of a start,
  double share_of_run = 0.25;     ///< and of the longest run
  std::size_t first_rows = 6;     ///< too few for a current that changes after the first to have moved much
  double counts = 4.0;            ///< moved in these rows beyond the model: the run had not settled,
  double jitters = 6.0;           ///< and so many of the encoder's,
  double beyond_model = 3.0;      ///< and so many times what the model moves
  double share_of_gap = 0.5;      ///< of what is left lies in the start: suspect,
  double over_time = 2.0;         ///< if that is so many times its share of the time
};

/// The next measurement. Its menu of currents is in plan.cpp.
struct PlanThresholds {
  double lasting_s = 10.0;   ///< of a current
  double least_power = 0.1;  ///< probability to tell, that is worth proposing
  std::size_t refitted = 8;  ///< items that promise most, for which the other explanation is fitted again
  std::array<double, 3> loads{1.0, 0.5, 1.3};  ///< of the data set's
  double same_load = 0.08;                     ///< relative: one load
  double least_rise = 0.05;  ///< contraction ratio at the highest pressure: a heavier load is not proposed
};

}  // namespace mckibben::diagnose
