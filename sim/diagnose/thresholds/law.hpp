// Thresholds of stage 5, law: waves and terms of a force that no effect of the catalogue explains.
#pragma once

#include <array>
#include <cstddef>

namespace mckibben::diagnose {

struct LawThresholds {
  std::size_t most_terms = 3;
  std::size_t most_fits = 4;  ///< proposals that are fitted, of each base
  double bent = 4.0;  ///< left by numbers that may have bent to imitate a law: the rig as described is a base
  double same_wave = 0.15;  ///< logarithm: waves of lengths so near are one proposal
  double no_slope = 1e-12;  ///< sum of squares that is rounding below
  /// Forces for slopes: next to nothing, and of sizes that matter of most terms, because a muscle that swings
  /// answers a small change in another way than a large one.
  std::array<double, 5> probes_N{0.01, 5.0, -5.0, 40.0, -40.0};
  std::array<double, 2> wave_probes_N{0.01, 3.0};
  double first_periods = 1.0, last_periods = 20.0, step_periods = 0.5;  ///< of a wave over the largest rise
  double most_N = 1e4;                                                  ///< of a coefficient
  double step_N = 0.01;                                                 ///< for a slope
  double shorter = 0.7, longer = 1.4;  ///< than proposed, that a wave may become
  double wave_step = 1e-3;             ///< logarithm of its length, and its phase [rad], for a slope
  double most_phase = 7.0;             ///< rad: more than a turn, so that no bound is in the way
  double told_phase = 0.005;           ///< rad: less is not told
};

}  // namespace mckibben::diagnose
