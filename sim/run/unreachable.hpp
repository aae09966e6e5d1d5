// What a target asks beyond what a load can do on its rig (`reachable`), and what would help. T 5 takes such
// targets for the likely cause of the thesis's errors.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <controllers/reach.hpp>

namespace mckibben::run {

/// Ticks at which a limit is passed, and the tick at which it is passed by most.
struct Beyond {
  std::size_t ticks = 0;
  double asked = 0.0, limit = 0.0;  ///< contraction ratio, or magnitude of its speed [1/s]
  double ratio = 0.0;               ///< contraction ratio there
  bool up = true;                   ///< direction there

  void note(double asked_here, double limit_here, double ratio_here, bool up_here);
};

struct Unreachable {
  std::size_t ticks = 0, of_ticks = 0;          ///< out of the rig's reach, of all
  std::size_t ticks_without_current_speed = 0;  ///< no current speed in the calibration gives the target's
  Beyond too_fast, too_high, too_low;

  bool any() const { return ticks > 0 || ticks_without_current_speed > 0; }
  /// Parts of it: heights no controller brings a load to; speeds are of the way that one plans.
  Unreachable heights() const;
  Unreachable speeds() const;
  /// What is out of reach, by how much, and what would help; without full stop.
  std::string text() const;
};

/// Looks at a target tick by tick. A height passed by less than `tolerance` [contraction ratio] is none. Of
/// an empty `reach` it looks at heights alone.
Unreachable unreachable(const std::vector<double>& target, double tick_s, const controllers::Reach& reach,
                        const controllers::ReachOfLoad& limits, double tolerance);

/// The same for one contraction ratio to pass at one speed [1/s], negative on the way down.
Unreachable unreachable(double ratio, double speed_per_s, const controllers::Reach& reach,
                        const controllers::ReachOfLoad& limits);

}  // namespace mckibben::run
