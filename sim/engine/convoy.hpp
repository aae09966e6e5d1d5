// Rigs side by side in lanes, each in steps of its own and at times of its own: what becomes of one does not
// depend on the others, to the bit. For runs that have nothing to do with each other; differences between
// rigs want common steps (flock.hpp).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <plant/plant.hpp>
#include <sim/engine/flock.hpp>
#include <sim/engine/integrator.hpp>

namespace mckibben::engine {

/// What tells rigs apart besides numbers: those of one kind can always go abreast, whichever they are.
using Kind = std::vector<std::optional<long>>;
Kind kind_of(const plant::Rig& rig);

class Convoy {
 public:
  Convoy() = default;
  Convoy(const Convoy&) = delete;
  Convoy& operator=(const Convoy&) = delete;
  virtual ~Convoy() = default;

  /// So many cost what one does.
  static constexpr std::size_t wing = 8;
  static constexpr std::size_t places = 2 * wing;

  /// Puts a rig in a place, whatever was there. All rigs of a convoy are of one kind (kind_of).
  virtual void board(std::size_t place, const plant::Plant& plant) = 0;
  /// The rig sets off from where the flow is, with what it holds frozen, to the next instant [s]. The flow
  /// outlives the way.
  virtual void set_off(std::size_t place, Bound bound, double from_s, double to_s) = 0;

  /// Calls `arrived(place, true)` when a rig has come to its instant; its flow is there then. With false it
  /// can go no further in steps of a size that makes sense, and its flow is where it set off. The call may
  /// set the rig off again, or board another one; else the place stays empty. Returns when nobody is under
  /// way. Throws what `arrived` throws.
  using Arrived = std::function<void(std::size_t place, bool arrived)>;
  virtual void go(const Arrived& arrived) = 0;

  /// Of the rig that is at a place, since it boarded.
  virtual Counters counters(std::size_t place) const = 0;
  virtual Pace pace(std::size_t place) const = 0;
};

/// For rigs with LuGre friction and one muscle, whose effects remember something or not.
std::unique_ptr<Convoy> make_convoy(bool remembers, double tolerance);

/// Whether such a rig can go in a convoy.
bool can_join_a_convoy(const plant::Rig& rig);

}  // namespace mckibben::engine
