// The rig as a thing that is stepped, by whatever drives it: a rider with an integrator.
#pragma once

#include <memory>
#include <span>

#include <sim/engine/integrator.hpp>
#include <sim/ride/rider.hpp>

namespace mckibben::ride {

/// Carries riders, each with its integrator, to the next instant of all; touches no heap. Throws
/// NumericalFailure.
void advance(std::span<Rider> riders, std::span<const std::unique_ptr<engine::Integrator>> integrators);

class Ride {
 public:
  /// All that changes on the way.
  struct Saved {
    Rider::State rider;
    engine::Pace pace;
  };

  Ride(const Loaded& loaded, const solver::Settings& settings, bool keep_ledger = false)
      : Ride(Rider(loaded), settings, keep_ledger) {}
  /// Goes on from where the rider is.
  Ride(const Rider& rider, const engine::Pace& pace, const solver::Settings& settings,
       bool keep_ledger = false);
  Ride(const Ride& other) : Ride(*other.rider_, other.settings_, other.keep_ledger_) {
    restore(other.save());
  }
  Ride(Ride&&) = default;
  Ride& operator=(Ride&&) = default;
  ~Ride() = default;

  void start(const Drive& drive, double at_s) { rider_->start(drive, at_s); }

  /// An instant and the way to the next [s]; touches no heap. Throws NumericalFailure; the ride is then where
  /// it last came to.
  void step(const Drive& drive, double until_s) {
    hold(drive, until_s);
    advance();
  }

  // A step's two halves, for those who look at the moment between them.
  void hold(const Drive& drive, double until_s) { rider_->hold(drive, until_s); }
  void advance() { ride::advance({rider_.get(), 1}, {&integrator_, 1}); }

  Rider& rider() { return *rider_; }
  const Rider& rider() const { return *rider_; }
  const plant::Plant& plant() const { return rider_->plant(); }
  const engine::Flow& flow() const { return rider_->now.flow; }
  const plant::Held& held() const { return rider_->now.held; }
  const Reading& reading() const { return rider_->now.reading; }
  plant::Moment<double> moment() const { return rider_->moment(); }
  double time_s() const { return rider_->now.time_s; }
  engine::Counters counters() const { return integrator_->counters(); }

  /// Nothing has come or gone from here on.
  void open_ledger() { rider_->open_ledger(); }

  /// A ride that goes on from what was saved goes the same way, to the bit. `saved` is of a ride with the
  /// same settings.
  Saved save() const { return {rider_->now, integrator_->pace()}; }
  void save(Saved& into) const;  ///< touches no heap if `into` was saved into before
  void restore(const Saved& saved);

 private:
  Ride(Rider rider, const solver::Settings& settings, bool keep_ledger);

  std::unique_ptr<Rider> rider_;  // stays where it is: the integrator refers to its plant
  solver::Settings settings_;
  bool keep_ledger_;
  std::unique_ptr<engine::Integrator> integrator_;
};

}  // namespace mckibben::ride
