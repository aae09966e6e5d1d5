// Several rigs carried side by side under the same current and in the same steps, for differences between
// them: what the discretisation does wrong, it does to all alike, so that a difference over a tiny change of
// a parameter is its sensitivity to many digits (differences of runs with steps of their own are noise).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <plant/plant.hpp>
#include <sim/engine/integrator.hpp>

namespace mckibben::engine {

/// A rig on its way, and what it holds.
struct Bound {
  Flow* flow;
  const plant::Held* held;
};

class Flock {
 public:
  Flock() = default;
  Flock(const Flock&) = delete;
  Flock& operator=(const Flock&) = delete;
  virtual ~Flock() = default;

  /// Most rigs that fly together.
  static constexpr std::size_t most = 8;

  /// Carries each rig's flow from one instant to the next [s] with what it holds frozen. Throws
  /// NumericalFailure (of the first rig).
  virtual void advance(std::span<const Bound> bound, double from_s, double to_s) = 0;

  virtual Pace pace() const = 0;
  virtual void resume(const Pace& pace) = 0;
};

/// A flock of 1 to `most` plants, of one muscle each or of two each. LuGre friction only: exact stick and
/// slip switches each rig at a time of its own. Throws std::invalid_argument.
std::unique_ptr<Flock> make_flock(std::span<const plant::Plant> plants, double tolerance);

}  // namespace mckibben::engine
