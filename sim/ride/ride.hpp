// The rig as a thing that is stepped, by whatever drives it: a rider with an integrator, or several under the
// same drive, in common steps where they can be had, for differences between rigs that are free of the noise
// of steps.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <sim/engine/flock.hpp>
#include <sim/engine/integrator.hpp>
#include <sim/ride/rider.hpp>

namespace mckibben::ride {

/// Whether rigs can ride in common steps: none with exact stick and slip, and not with CVODE.
bool can_share_steps(std::span<const Hanging> rigs, solver::Method method);
bool can_share_steps(std::span<const Paired> pairs, solver::Method method);

class Ride {
 public:
  /// All that changes on the way: of each rider, and of each integrator.
  struct Saved {
    std::vector<Rider::State> riders;
    std::vector<engine::Pace> paces;
  };

  /// 1 to engine::Flock::most rigs. In common steps they have no ledger. Throws std::invalid_argument.
  Ride(std::span<const Hanging> rigs, const solver::Settings& settings, bool keep_ledger = false);
  Ride(const Hanging& rig, const solver::Settings& settings, bool keep_ledger = false)
      : Ride(std::span(&rig, 1), settings, keep_ledger) {}
  Ride(std::span<const Paired> pairs, const solver::Settings& settings, bool keep_ledger = false);
  Ride(const Paired& pair, const solver::Settings& settings, bool keep_ledger = false)
      : Ride(std::span(&pair, 1), settings, keep_ledger) {}
  /// Goes on from where the rider is.
  Ride(const Rider& rider, const engine::Pace& pace, const solver::Settings& settings,
       bool keep_ledger = false);
  Ride(const Ride& other);
  Ride(Ride&&) = default;
  Ride& operator=(Ride&&) = default;
  ~Ride() = default;

  void start(const Drive& drive, double at_s);

  /// An instant and the way to the next [s]; touches no heap. Throws NumericalFailure; the ride is then where
  /// it last came to.
  void step(const Drive& drive, double until_s) {
    hold(drive, until_s);
    advance();
  }

  // A step's two halves, for those who look at the moment between them.
  void hold(const Drive& drive, double until_s);
  void advance();

  std::size_t rigs() const { return riders_.size(); }
  Rider& rider(std::size_t rig = 0) { return riders_[rig]; }
  const Rider& rider(std::size_t rig = 0) const { return riders_[rig]; }
  std::span<Rider> riders() { return riders_; }
  const plant::Plant& plant(std::size_t rig = 0) const { return riders_[rig].plant(); }
  const engine::Flow& flow(std::size_t rig = 0) const { return riders_[rig].now.flow; }
  const plant::Held& held(std::size_t rig = 0) const { return riders_[rig].now.held; }
  const Reading& reading(std::size_t rig = 0) const { return riders_[rig].now.reading; }
  plant::Moment<double> moment(std::size_t rig = 0) const { return riders_[rig].moment(); }
  double time_s() const { return riders_.front().now.time_s; }
  /// What the solver of the first rig did. Not of rigs in common steps.
  engine::Counters counters() const;

  /// Nothing has come or gone from here on.
  void open_ledger();

  /// A ride that goes on from what was saved goes the same way, to the bit. `saved` is of a ride of as many
  /// rigs with the same settings.
  Saved save() const;
  void save(Saved& into) const;  ///< touches no heap if `into` was saved into before
  void restore(const Saved& saved);

 private:
  template <class Of>
  void seat(std::span<const Of> rigs);
  void make_integrators();
  void carry(double to_s);

  std::vector<Rider> riders_;  // stay where they are: integrators refer to their plants
  solver::Settings settings_;
  bool together_ = false, keep_ledger_;
  std::unique_ptr<engine::Flock> flock_;                          // either this
  std::vector<std::unique_ptr<engine::Integrator>> integrators_;  // or one for each rig
};

}  // namespace mckibben::ride
