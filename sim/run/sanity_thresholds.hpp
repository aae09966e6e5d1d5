// Every number that sanity before physics goes by: its unit, what it means, where it comes from.
//
// Chosen by hand so that no effect of the catalogue and no muscle a third stronger or weaker is taken for a
// wrong unit or label; tests/run/sanity_test.cpp tries them.
#pragma once

#include <cstddef>

namespace mckibben::run {

/// kg, by definition.
inline constexpr double pound_kg = 0.45359237;

/// How much is simulated for a look.
struct LookThresholds {
  std::size_t most_rows = 200'000;  ///< a few seconds' work: the thesis's campaign
  std::size_t most_rows_of_a_run = 20'000;
};

/// Columns. Slopes are of what was measured over what the rig would do.
struct ColumnThresholds {
  double same = 1.25;           ///< factors as near as that are one
  double near_one = 2.0;        ///< factors that effects reach: no unit is told by less,
  double far = 5.0;             ///< and one by less only if
  double scaled_share = 0.04;   ///< of the sum of squares is left with the scale taken out
  double alike = 0.8;           ///< correlation with the model, if only the unit is wrong
  double moving_counts = 20.0;  ///< that a column must move to be judged
  double beyond_rig = 1.2;      ///< times what a muscle can do, or a supply has: the unit is too small
  double rounding_mA = 1e-6;    ///< above the DAC's range
  double within_supply =
      1.05;  ///< times the supply [bar], as a number: what is called current may be a pressure
  double amperes = 1.0 / 400.0;      ///< of the valve's span: currents so small are amperes
  double fallen_slope = -0.3;        ///< the sign is the other one,
  double fallen_correlation = -0.5;  ///< if these are below
  double gauge_bar = 0.3;            ///< that the model's pressure must move to judge a gauge's unit
  double least_gauge_slope = 0.5, most_gauge_slope = 2.0;  ///< of a gauge in the right unit
  double atmosphere = 0.2;                                 ///< relative: an offset so near to it is it
};

/// Loads, weighed by the muscle.
struct LoadThresholds {
  double lifted = 0.01;         ///< contraction ratio of a load that hangs and does not rest
  std::size_t least_rows = 40;  ///< of those
  std::size_t still_rows = 20;  ///< each way: a reading at the end of its range, or frozen,
  double moving = 0.01;         ///< if the simulated load moves so far meanwhile, contraction ratio
  double compared_share =
      0.5;  ///< of the rows in which the simulated load hangs as well: then it is compared
  double least_difference = 0.08;  ///< of the heavier of two loads that are compared
  double reversed = 0.5;           ///< of that difference: so far the other way round
  double agrees = 0.35;            ///< the same with the labels exchanged
  double near_grams = 2.0;     ///< factors, round kg written in g, N and pounds; a muscle of half or twice
  double near_newtons = 1.25;  ///< the force comes near to pounds, none to the others
  double near_pounds = 1.2, sure_pounds = 1.08;
};

struct SanityThresholds {
  LookThresholds look{};
  ColumnThresholds column{};
  LoadThresholds load{};
};

inline constexpr SanityThresholds sanity_thresholds{};

}  // namespace mckibben::run
