// What counting a quarter degree every 12 ms does to speed and acceleration (T 3.3), and so to the load that
// T 4.31 weighs.
#pragma once

#include <array>
#include <map>
#include <string_view>

#include <sim/study/study.hpp>

namespace mckibben::study {

/// One measured quantity over many rows.
struct Counted {
  Tally truly;     ///< true value
  Tally error;     ///< counted less true
  Tally rounding;  ///< counted less the same difference of true positions
  Tally lateness;  ///< that difference less the true value at the instant
};

/// Which acceleration T 4.31 is given.
enum Acceleration : std::size_t { counted, neglected, truly };
inline constexpr std::array<std::string_view, 3> accelerations{"counted", "neglected", "true"};
using Errors = std::array<Tally, accelerations.size()>;  ///< of the load [kg]

/// Errors of the load over rows of contraction, one row at a time, and of the means of whole runs.
struct Weighings {
  std::map<double, Errors> by_load, by_speed;
  Errors all, runs;
};

struct Counting {
  double speed_step_per_s = 0.0, acceleration_step_per_s2 = 0.0, acceleration_step_m_per_s2 = 0.0;
  std::map<double, Counted> speed_per_s, acceleration_m_per_s2;  ///< by current speed
  Counted all_speed_per_s, all_acceleration_m_per_s2;
  Weighings alone;    ///< all but the acceleration true: pressure and friction as they were
  Weighings thesiss;  ///< pressure from the current, friction as calibrated with counted accelerations
};

Counting measure_counting(const Evidence& evidence);
Study study_counting(const Evidence& evidence);

}  // namespace mckibben::study
