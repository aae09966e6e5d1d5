// A rider and what carries it; see the header.
#include <utility>

#include <sim/ride/ride.hpp>

namespace mckibben::ride {

void advance(std::span<Rider> riders, std::span<const std::unique_ptr<engine::Integrator>> integrators) {
  for (const Rider& rider : riders) rider.require_reading();
  double to_s = 0.0;
  do {
    to_s = next_s(riders);
    for (std::size_t i = 0; i < riders.size(); ++i)
      integrators[i]->advance(riders[i].now.flow, riders[i].now.held, riders[i].now.time_s, to_s);
  } while (!arrive(riders, to_s));
  for (const Rider& rider : riders) rider.require_reading();
}

Ride::Ride(Rider rider, const solver::Settings& settings, bool keep_ledger)
    : rider_(std::make_unique<Rider>(std::move(rider))),
      settings_(settings),
      keep_ledger_(keep_ledger),
      integrator_(engine::make_integrator(rider_->plant(), settings, keep_ledger)) {}

Ride::Ride(const Rider& rider, const engine::Pace& pace, const solver::Settings& settings, bool keep_ledger)
    : Ride(rider, settings, keep_ledger) {
  integrator_->resume(pace);
}

void Ride::save(Saved& into) const {
  into.rider = rider_->now;
  into.pace = integrator_->pace();
}

void Ride::restore(const Saved& saved) {
  rider_->now = saved.rider;
  integrator_->resume(saved.pace);
}

}  // namespace mckibben::ride
