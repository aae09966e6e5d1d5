// Thresholds of stage 1, check: labels of loads, runs at fault, and what nobody can see. Those of single
// readings are in sim/data/thresholds.hpp.
#pragma once

#include <array>
#include <cstddef>

namespace mckibben::diagnose {

/// Labels of loads. Set on 64 data sets: each effect of the catalogue at twice its typical size, each
/// parameter at three prior deviations, nine runs, five loads; no label was doubted wrongly, of 2304
/// exchanged ones 6 missed.
struct LabelThresholds {
  std::size_t least_runs = 4;  ///< whose labels can contradict each other
  std::size_t least_left = 3;  ///< that must be left to judge a further one
  double spreads = 4.0;        ///< median absolute deviations of the other runs' offsets
  double sure_kg = 0.3;        ///< an offset that a parameter in error makes: this,
  double sure_share = 0.04;    ///< and of the load
  double trend = 0.1;  ///< of a load's distance to the others: parameters in error scatter offsets as much
  double still_there = 0.5;    ///< of the sum of squares, that may be left with the load that fits
  double others_suffer = 1.4;  ///< growth of theirs with the same offset, at least
  double exact_kg = 0.03;      ///< smaller steps do not matter
  double step_kg = 0.01;       ///< for a slope
  double least_kg = 0.1;       ///< of a load that is tried
  double least_step = -0.5;    ///< of the load, down,
  double most_step = 1.0;      ///< and up, in one step
  int steps = 6;               ///< of the descent, at most
  double pounds = 0.06;        ///< relative, round a pound: all loads are written in pounds
};

/// Runs at fault.
struct FaultThresholds {
  double unquestioned = 4.0;     ///< mean square of a run that raises no question
  double strictly_better = 0.3;  ///< of the misfit that the rig, or an effect, leaves: what faults may leave
  double explained = 0.03;       ///< of a run's misfit: a shape explains it if no more is left
  double another_rig =
      64.0;  ///< mean square of a run that no shape explains; less a law leaves that is not right
  double for_choice = 0.9;        ///< of its gain counts where a shape chooses the row where it begins
  std::size_t least_sound = 3;    ///< runs that must be sound,
  std::size_t sound_for_one = 2;  ///< and so many for each that is not
  std::size_t most_tried = 6;     ///< the worst runs that are tried as the odd one
  std::size_t spare_runs = 3;     ///< runs more than loads, without which loads tell no sizes of faults
  double within_loads = 0.1;      ///< of their sum of squares, among runs of a load: loads tell them below
  double least_ticks = 0.6;       ///< sizes below are nothing to talk of: late, rows lost
  double least_scale = 0.004;     ///< of a current or of readings
  double least_mA = 0.03;         ///< of a command's offset, of the thesis's valve (Valve::per_mA)
  double least_bar = 0.01;        ///< of a given pressure's
  double least_drift = 5e-4;      ///< contraction ratio
  double least_counts = 0.6;      ///< of a zero, of slipped counts
  double whole_tick = 0.5;        ///< ticks: a line drawn at a lateness holds so near to it, if all are late
  double drawn_ticks = 0.25;      ///< the same of one run: this,
  double drawn_share = 0.3;       ///< and of the size that it was drawn at
  std::array<int, 6> common_ticks{-1, -2, -3,
                                  -4, -5, -6};  ///< that all runs may be late by: early. Late is an effect
  int most_ticks = 12;                          ///< that one run may be late by, or early
  std::array<int, 6> lost_ticks{2, 5, 10, -2, -5, -10};  ///< rows that may be lost, or double
  long beginnings = 60;            ///< rows at which something may have begun, evenly spread
  double current_share = 0.02;     ///< of the current, for a slope
  double current_mA = 0.1;         ///< for a slope, the same
  double pressure_bar = 0.03;      ///< for a slope
  double worth_suspecting = 0.75;  ///< of what any effect leaves of a run: one beside a fault must leave less
  std::size_t most_suspected = 3;  ///< effects beside faults of a few runs, and beside one of all
  int most_repairs = 2;            ///< how often data are mended and looked at again
  double rounding = 1e-10;         ///< of a column's square: others imitate it but for rounding
};

/// What nobody can see.
struct NoiseThresholds {
  double least_ratio = 5e-5;    ///< contraction ratio: no sensor of a lab does better, no simulation needs to
  double sheet_noise = 2.0;     ///< times its data sheet's: a sensor that scatters more is said to
  double least_force_N = 0.02;  ///< no load cell of a bench does better
  double least_pressure_Pa = 50.0;  ///< no gauge does better
  double first_decimal = 1e-3;      ///< the coarsest that readings are rounded to,
  double last_decimal = 1e-7;       ///< and the finest that is told from none
  double decimal_error = 1e-6;      ///< of a decimal: rounding of the arithmetic
  double whole_count = 0.01;        ///< counts: nearer is whole
  double telling_count = 0.2;       ///< counts: decimals so coarse make everything whole
  double counted_share = 0.99;      ///< of the readings must be whole
  double normal_median = 0.6745;    ///< median of the size of a normal variable, in deviations. Derived
  std::size_t steady_ticks = 6;     ///< each way, in which the load's speed is taken as steady
  double straight_counts = 2.0;     ///< what the load may bend by in these
  double fastest = 1.0;             ///< counts a tick: faster, the speed matters more than the jitter
  double largest = 6.0;             ///< counts of a difference: more is a jump
  std::size_t speed_bins = 25;      ///< up to the fastest
  int waves = 40;                   ///< of the series for what counts do: beyond it nothing is left
  double most_jitter = 2.0;         ///< counts
  double jitter_error = 1e-4;       ///< counts: exact enough
};

}  // namespace mckibben::diagnose
