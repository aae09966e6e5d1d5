// What the rig can follow, as plain tables over contraction and load: the thesis names these limits as the
// likely cause of its errors and leaves them open (T 5). The numbers come from whoever knows the plant.
#pragma once

#include <vector>

namespace mckibben::controllers {

/// One load's limits.
struct ReachOfLoad {
  double load_kg = 0.0;
  double lowest_rising = 0.0;   ///< where it comes to rest at zero pressure if it comes from below
  double lowest_falling = 0.0;  ///< and from above, held up by the threads
  double highest = 0.0;         ///< where it comes to rest at span pressure, from below

  // At each contraction ratio of the table: largest speed of contraction and of relaxation [1/s], both
  // positive, and how far muscle pressure stays behind the current in a slow ramp up and down [s].
  std::vector<double> rising_per_s, falling_per_s;
  std::vector<double> rising_lag_s, falling_lag_s;
};

struct Reach {
  std::vector<double> ratio;  ///< contraction ratios of the tables, ascending
  std::vector<ReachOfLoad> loads;

  bool empty() const { return ratio.empty() || loads.empty(); }

  /// The limits of a load between those of the table: linear between the two nearest, the end's outside.
  /// Only if not empty.
  ReachOfLoad at_load(double load_kg) const;

  /// A column of `at_load` at a contraction ratio: linear between its rows, the end's outside.
  double at_ratio(const std::vector<double>& column, double contraction_ratio) const;
};

/// A target slowed to what is reachable: each sample as near to the target's as the speed limits and the ends
/// allow. It arrives later, at the same heights where they can be reached.
std::vector<double> slowed(const std::vector<double>& target, double tick_s, const Reach& reach,
                           const ReachOfLoad& load);

}  // namespace mckibben::controllers
