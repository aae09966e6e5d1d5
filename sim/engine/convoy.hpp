// Rigs side by side in lanes, in parties: a rig alone, or several under the same drive whose differences are
// wanted, in common steps (as in a flock). Each party goes in steps of its own and at times of its own: what
// becomes of it does not depend on the others, to the bit.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <plant/plant.hpp>
#include <sim/engine/flock.hpp>
#include <sim/engine/integrator.hpp>

namespace mckibben::engine {

/// What tells rigs apart besides numbers: those of one kind can always go abreast, whichever they are.
using Kind = std::vector<std::optional<long>>;
/// Of a party; none if two of its rigs differ in it.
std::optional<Kind> kind_of(std::span<const plant::Rig* const> party);

class Convoy {
 public:
  Convoy() = default;
  Convoy(const Convoy&) = delete;
  Convoy& operator=(const Convoy&) = delete;
  virtual ~Convoy() = default;

  /// So many cost what one does.
  static constexpr std::size_t wing = 8;
  static constexpr std::size_t places = 2 * wing;

  /// Seats a party of 1 to `wing` rigs, whoever was there. The first of the places stands for all of it from
  /// here on. All rigs of a convoy are of one kind (kind_of).
  virtual void board(std::span<const std::size_t> places, std::span<const plant::Plant* const> party) = 0;
  /// The party sets off from where its flows are, with what they hold frozen, to the next instant [s]. The
  /// flows outlive the way.
  virtual void set_off(std::size_t place, std::span<const Bound> party, double from_s, double to_s) = 0;

  /// Calls `arrived(place, true)` when a party has come to its instant; its flows are there then. With false
  /// it can go no further in steps of a size that makes sense, and its flows are where it set off. The call
  /// may set the party off again, or board another one; else the places stay empty. Returns when nobody is
  /// under way. Throws what `arrived` throws.
  using Arrived = std::function<void(std::size_t place, bool arrived)>;
  virtual void go(const Arrived& arrived) = 0;

  /// Of the party that is at a place, since it boarded.
  virtual Counters counters(std::size_t place) const = 0;
  virtual Pace pace(std::size_t place) const = 0;
};

/// For up to `most` rigs at a time (of places) that can join, with one muscle each, whose effects remember
/// something or not. `keep_ledger`: carry ledgers along, at some cost.
std::unique_ptr<Convoy> make_convoy(bool remembers, bool keep_ledger, double tolerance, std::size_t most);

/// Whether such a rig can go in a convoy: with LuGre friction, and no ledger to keep of a gas with a
/// temperature.
bool can_join_a_convoy(const plant::Rig& rig, bool keep_ledger);

}  // namespace mckibben::engine
