// Many riders that have nothing to do with each other, side by side in an engine's convoy: each in steps of
// its own and at instants of its own. What becomes of one does not depend on the others, to the bit.
#pragma once

#include <functional>

#include <sim/engine/convoy.hpp>
#include <sim/ride/rider.hpp>
#include <sim/solver/settings.hpp>

namespace mckibben::ride {

/// Who rides, and is asked at each instant what comes next.
class Passenger {
 public:
  Passenger() = default;
  Passenger(const Passenger&) = delete;
  Passenger& operator=(const Passenger&) = delete;
  virtual ~Passenger() = default;

  /// Has been started.
  virtual Rider& rider() = 0;
  /// At an instant: has held what acts until the next one; false if this was the last. May throw.
  virtual bool go_on() = 0;
  /// It got off where it is.
  virtual void end(const engine::Counters& solver) = 0;
  /// It has to go on by itself with what it holds: no step is small enough, or too many are needed.
  virtual void alone(const engine::Pace& pace, const engine::Counters& solver) = 0;
};

/// Whether a rig can ride so: LuGre friction, a method that may be explicit.
bool can_join_a_convoy(const plant::Rig& rig, solver::Method method);

/// Carries passengers, up to `places` (at most engine::Convoy::places) at a time, until `next` gives none any
/// more (null). All their rigs are of one kind (engine::kind_of). Throws what passengers throw.
void ride_in_convoy(const std::function<Passenger*()>& next, const solver::Settings& settings,
                    std::size_t places);

}  // namespace mckibben::ride
