// Riders and what carries them; see the header.
#include <algorithm>
#include <array>
#include <stdexcept>

#include <sim/ride/ride.hpp>

namespace mckibben::ride {

namespace {

template <class Of>
bool share_steps(std::span<const Of> rigs, solver::Method method) {
  return method != solver::Method::cvode && std::none_of(rigs.begin(), rigs.end(), [](const Of& one) {
           return one.rig.friction.memory == plant::FrictionMemory::coulomb;
         });
}

}  // namespace

bool can_share_steps(std::span<const Hanging> rigs, solver::Method method) {
  return share_steps(rigs, method);
}
bool can_share_steps(std::span<const Paired> pairs, solver::Method method) {
  return share_steps(pairs, method);
}

template <class Of>
void Ride::seat(std::span<const Of> rigs) {
  if (rigs.empty() || rigs.size() > engine::Flock::most)
    throw std::invalid_argument("a ride carries 1 to 8 rigs");
  together_ = rigs.size() > 1 && can_share_steps(rigs, settings_.method);
  for (const Of& one : rigs) riders_.emplace_back(one);
  make_integrators();
}

Ride::Ride(std::span<const Hanging> rigs, const solver::Settings& settings, bool keep_ledger)
    : settings_(settings), keep_ledger_(keep_ledger) {
  seat(rigs);
}

Ride::Ride(std::span<const Paired> pairs, const solver::Settings& settings, bool keep_ledger)
    : settings_(settings), keep_ledger_(keep_ledger) {
  seat(pairs);
}

Ride::Ride(const Rider& rider, const engine::Pace& pace, const solver::Settings& settings, bool keep_ledger)
    : riders_{rider}, settings_(settings), together_(false), keep_ledger_(keep_ledger) {
  make_integrators();
  integrators_.front()->resume(pace);
}

Ride::Ride(const Ride& other)
    : riders_(other.riders_),
      settings_(other.settings_),
      together_(other.together_),
      keep_ledger_(other.keep_ledger_) {
  make_integrators();
  restore(other.save());
}

void Ride::make_integrators() {
  if (together_) {
    std::vector<plant::Plant> plants;
    for (const Rider& rider : riders_) plants.push_back(rider.plant());
    flock_ = engine::make_flock(plants, settings_.tolerance);
  } else {
    for (const Rider& rider : riders_)
      integrators_.push_back(engine::make_integrator(rider.plant(), settings_, keep_ledger_));
  }
}

void Ride::start(const Drive& drive, double at_s) {
  for (Rider& rider : riders_) rider.start(drive, at_s);
}

void Ride::hold(const Drive& drive, double until_s) {
  for (Rider& rider : riders_) rider.hold(drive, until_s);
}

void Ride::advance() {
  for (const Rider& rider : riders_) rider.require_reading();
  double to_s = 0.0;
  do {
    to_s = next_s(riders_);
    carry(to_s);
  } while (!arrive(riders_, to_s));
  for (const Rider& rider : riders_) rider.require_reading();
}

void Ride::carry(double to_s) {
  const double from_s = time_s();
  if (flock_) {
    std::array<engine::Bound, engine::Flock::most> bound;
    for (std::size_t i = 0; i < riders_.size(); ++i) bound[i] = {&riders_[i].now.flow, &riders_[i].now.held};
    flock_->advance(std::span(bound).first(riders_.size()), from_s, to_s);
  } else {
    for (std::size_t i = 0; i < riders_.size(); ++i)
      integrators_[i]->advance(riders_[i].now.flow, riders_[i].now.held, from_s, to_s);
  }
}

engine::Counters Ride::counters() const {
  return integrators_.empty() ? engine::Counters{} : integrators_.front()->counters();
}

void Ride::open_ledger() {
  for (Rider& rider : riders_) rider.open_ledger();
}

Ride::Saved Ride::save() const {
  Saved saved;
  save(saved);
  return saved;
}

void Ride::save(Saved& into) const {
  into.riders.resize(riders_.size());
  for (std::size_t i = 0; i < riders_.size(); ++i) into.riders[i] = riders_[i].now;
  into.paces.clear();
  if (flock_) into.paces.push_back(flock_->pace());
  for (const auto& integrator : integrators_) into.paces.push_back(integrator->pace());
}

void Ride::restore(const Saved& saved) {
  for (std::size_t i = 0; i < riders_.size(); ++i) riders_[i].now = saved.riders[i];
  if (flock_) flock_->resume(saved.paces.front());
  for (std::size_t i = 0; i < integrators_.size(); ++i) integrators_[i]->resume(saved.paces[i]);
}

}  // namespace mckibben::ride
