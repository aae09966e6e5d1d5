// Thresholds of stage 3, where: the cells of the map, and when one is significant.
#pragma once

#include <array>

namespace mckibben::diagnose {

struct WhereThresholds {
  int flips = 999;                  ///< of signs, for a p-value. Convention: a p-value of 1/1000 can be seen
  double same_sum = 1e-12;          ///< relative: as large
  double false_discoveries = 0.05;  ///< share of those called significant. Convention
  double rest_mm_per_s = 0.5;       ///< slower is standing
  std::array<double, 3> speeds_mm_per_s{5.0, 25.0, 100.0};    ///< between cells
  double rest_deg_per_s = 1.0;                                ///< slower a joint stands
  std::array<double, 3> speeds_deg_per_s{10.0, 50.0, 200.0};  ///< of a joint, between cells
  int pressures = 5, contractions = 6, times = 4;             ///< cells of equal width
  std::array<double, 2> start_s{1.0, 4.0};                    ///< between cells
  std::array<double, 3> since_reversal_s{0.1, 0.5, 2.0};      ///< between cells
  double dense_share = 0.25;  ///< of the gap, that a cell must hold where a gap is said to lie,
  double density = 1.5;       ///< and so many times its share of the time
};

}  // namespace mckibben::diagnose
