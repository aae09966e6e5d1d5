// How much of the friction that the thesis finds is the lag of valve and hose: it took the pressure from the
// current (T 3.3), and the muscle's own pressure comes later.
#pragma once

#include <array>
#include <map>
#include <vector>

#include <sim/study/study.hpp>

namespace mckibben::study {

/// All used rows of one direction and current speed.
struct LagAtSpeed {
  double speed_mA_per_s = 0.0;
  Tally shift_Pa;                         ///< pressure from the current less the muscle's own
  double lag_s = 0.0;                     ///< L in shift = s di/dt L, least squares through zero
  Tally from_current, from_gauge, truly;  ///< friction coefficient
};

/// Error of the load by T 4.31 over the rows of contraction [kg].
struct Weighed {
  Tally from_current;   ///< pressure from the current, friction calibrated with it
  Tally from_gauge;     ///< pressure of the gauge, friction calibrated with it
  Tally true_friction;  ///< pressure from the current, but the true friction
};

struct Lag {
  std::array<std::vector<LagAtSpeed>, 2> speeds;  ///< by Direction
  std::map<double, Weighed> weighed;              ///< by load
  Weighed weighed_all;

  const std::vector<LagAtSpeed>& of(thesis::Direction direction) const {
    return speeds[static_cast<std::size_t>(direction)];
  }
};

Lag measure_lag(const Evidence& evidence);
Study study_lag(const Evidence& evidence);

}  // namespace mckibben::study
