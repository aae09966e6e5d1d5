// Rigs in the lanes of SIMD vectors, in groups: a rig alone, or several under the same input in common steps,
// whose differences are then sensitivities. Each group has step sizes and instants of its own: its result
// does not depend on the others, to the bit.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <plant/plant.hpp>
#include <sim/engine/integrator.hpp>

namespace mckibben::engine {

/// What distinguishes rigs other than parameter values: those of one kind can always share lanes.
using Kind = std::vector<std::optional<long>>;
/// Of a group; none if two of its plants differ in it.
std::optional<Kind> kind_of(std::span<const plant::Plant* const> group);

/// A rig that is to be carried, and what it holds.
struct Bound {
  Flow* flow;
  const plant::Held* held;
};

class Batch {
 public:
  Batch() = default;
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;
  virtual ~Batch() = default;

  /// SIMD width: so many rigs cost what one does. A group has no more.
  static constexpr std::size_t width = 8;
  static constexpr std::size_t most_lanes = 2 * width;

  /// Gives free lanes to a group; its slot, or none if there are too few. All rigs of a batch are of one
  /// kind.
  virtual std::optional<std::size_t> submit(std::span<const plant::Plant* const> group) = 0;
  /// Frees a group's lanes.
  virtual void evict(std::size_t slot) = 0;
  /// The group is to be carried from one instant to the next [s], with what it holds frozen. Its flows
  /// outlive that.
  virtual void advance(std::size_t slot, std::span<const Bound> group, double from_s, double to_s) = 0;

  /// Calls `arrived(slot, true)` when a group has been carried to its next instant; its flows are there then.
  /// With false no reasonable step size gets it further, and its flows are where it began. The call may
  /// advance the group again, evict it, submit others. Returns when nothing is left to carry. Throws what
  /// `arrived` throws.
  using Arrived = std::function<void(std::size_t slot, bool arrived)>;
  virtual void run(const Arrived& arrived) = 0;

  /// Of a group, since it was submitted.
  virtual Counters counters(std::size_t slot) const = 0;
  virtual Pace pace(std::size_t slot) const = 0;
  /// As an integrator resumes: of a group that has just been submitted.
  virtual void resume(std::size_t slot, const Pace& pace) = 0;
  /// Whether it turned out stiff, as the automatic method decides; to be asked once at each instant.
  virtual bool is_stiff(std::size_t slot) = 0;
};

/// What all rigs of a batch have. No exact stick and slip: that switches each rig at a time of its own.
struct BatchShape {
  bool pairs = false;  ///< of muscles
  plant::Memories memories = plant::Memories::none;
  bool keep_ledger = false;  ///< of isothermal gas, not of pairs; at some cost
  bool mixed = false;        ///< rigs differ in kind; at some cost

  auto operator<=>(const BatchShape&) const = default;
};
std::unique_ptr<Batch> make_batch(const BatchShape& shape, double tolerance, std::size_t lanes);

}  // namespace mckibben::engine
