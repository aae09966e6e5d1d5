// The rig under a command, until nothing moves.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <tuple>

#include <controllers/controller.hpp>
#include <plant/rig.hpp>
#include <sim/ride/ride.hpp>

namespace mckibben::linear {

inline constexpr double hardly_Pa = 1e-6;

/// The slot of an effect's memory.
template <class Wanted, class... Effect>
constexpr std::size_t slot_in(const std::tuple<Effect...>*) {
  std::size_t slot = 0;
  bool before = true;
  ((before = before && !std::same_as<Wanted, Effect>, slot += before && plant::Remembers<Effect> ? 1 : 0),
   ...);
  return slot;
}
inline constexpr std::size_t lag_slot =
    slot_in<plant::ValveLag>(static_cast<const plant::Effects::Table*>(nullptr));

/// With threads that only damp: it comes to rest in the middle of where friction would hold it, from wherever
/// it comes.
plant::Rig without_friction(plant::Rig rig);

/// The rig, held by one command until nothing moves.
class Settled {
 public:
  Settled(const plant::Rig& rig, double load_kg, const controllers::Command& command);

  const plant::State<double>& state() const { return ride_.flow().state; }
  double position() const {
    const double ratio = state().joint.contraction_ratio;
    return ride_.plant().has_angle() ? ride_.plant().angle_rad(ratio) : ratio;
  }
  const ride::Ride& ride() const { return ride_; }
  bool settled = false;

 private:
  ride::Ride ride_;
};

/// Newton's steps to where no air flows, the load as it stands: an integrator leaves pressures a few Pa about
/// that, now on this side of a valve's kink, now on that. Whether they get there.
bool calm(ride::Ride& ride, const std::array<double, 2>& commands);

}  // namespace mckibben::linear
