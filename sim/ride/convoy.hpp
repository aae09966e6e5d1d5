// Many riders side by side in an engine's convoy, in parties: one alone, or several under the same drive
// whose differences are wanted, in common steps. Each party goes in steps of its own and at instants of its
// own. What becomes of one does not depend on the others, to the bit.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <tuple>

#include <plant/solver.hpp>
#include <sim/engine/convoy.hpp>
#include <sim/ride/rider.hpp>

namespace mckibben::ride {

/// A party that rides, and is asked at each instant what comes next.
class Party {
 public:
  Party() = default;
  Party(const Party&) = delete;
  Party& operator=(const Party&) = delete;
  virtual ~Party() = default;

  /// 1 to engine::Convoy::wing, which have been started and stay where they are.
  virtual std::span<Rider> riders() = 0;
  /// At an instant: all have held what acts until the next one; false if this was the last. May throw.
  virtual bool go_on() = 0;
  /// It got off where it is.
  virtual void end(const engine::Counters& solver) = 0;
  /// It has to go on by itself with what it holds: no step is small enough, or too many are needed; or its
  /// one rig is stiff.
  virtual void alone(const engine::Pace& pace, const engine::Counters& solver) = 0;
};

/// What parties must have in common to ride together.
struct ConvoyClass {
  bool remembers = false, keep_ledger = false;
  solver::Method method{};
  double tolerance = 0.0;
  plant::GivenPressure given{};
  bool length_is_given = false;
  engine::Kind kind{};

  bool operator<(const ConvoyClass& other) const {
    const auto all = [](const ConvoyClass& c) {
      return std::tie(c.remembers, c.keep_ledger, c.method, c.tolerance, c.given, c.length_is_given, c.kind);
    };
    return all(*this) < all(other);
  }
};

/// Whether a rig in a convoy turns out stiff, as the automatic method judges; to be asked at each instant.
class StiffWatch {
 public:
  bool is_stiff(const engine::Pace& pace, const engine::Counters& solver);

 private:
  long cost_before_ = 0;
};

/// Of rigs under one drive; none if they cannot ride so: more than the engine's wing, exact stick and slip,
/// CVODE, or different laws among them.
std::optional<ConvoyClass> convoy_class(std::span<const plant::Rig* const> rigs, const Drive& drive,
                                        const solver::Settings& settings, bool keep_ledger = false);

/// Carries parties of one class, on up to `places` (at most engine::Convoy::places) at a time, until `next`
/// gives none any more (null). Throws what parties throw.
void ride_in_convoy(const std::function<Party*()>& next, const ConvoyClass& all, std::size_t places);

}  // namespace mckibben::ride
