// The order of an instant; see the header.
#include <algorithm>
#include <stdexcept>

#include <sim/ride/ride.hpp>

namespace mckibben::ride {

bool can_share_steps(std::span<const Hanging> rigs, engine::Method method) {
  return method != engine::Method::cvode &&
         std::none_of(rigs.begin(), rigs.end(), [](const Hanging& hanging) {
           return hanging.rig.friction.memory == plant::FrictionMemory::coulomb;
         });
}

Ride::Ride(std::span<const Hanging> rigs, const engine::Settings& settings, bool keep_ledger)
    : settings_(settings),
      together_(rigs.size() > 1 && can_share_steps(rigs, settings.method)),
      keep_ledger_(keep_ledger) {
  if (rigs.empty() || rigs.size() > engine::Flock::most)
    throw std::invalid_argument("a ride carries 1 to 8 rigs");
  for (const Hanging& hanging : rigs) plants_.emplace_back(hanging.rig, hanging.load_kg);
  now_.flows.resize(rigs.size());
  now_.held.resize(rigs.size());
  now_.plays.resize(rigs.size());
  now_.readings.resize(rigs.size());
  make_integrators();
}

Ride::Ride(const Ride& other)
    : plants_(other.plants_),
      settings_(other.settings_),
      together_(other.together_),
      keep_ledger_(other.keep_ledger_) {
  make_integrators();
  restore(other.save());
}

void Ride::make_integrators() {
  if (together_)
    flock_ = engine::make_flock(plants_, settings_.tolerance);
  else
    for (const plant::Plant& plant : plants_)
      integrators_.push_back(engine::make_integrator(plant, settings_, keep_ledger_));
}

double Ride::reference_Pa(std::size_t rig, const Drive& drive) {
  const plant::Plant& plant = plants_[rig];
  const double wanted_Pa = plant.reference_pressure_Pa(drive.current_mA + drive.stray_current_mA);
  return plant.rig().effects.reference_Pa(wanted_Pa, now_.plays[rig]) + drive.stray_pressure_Pa;
}

void Ride::start(const Drive& drive, double at_s) {
  now_.time_s = at_s;
  now_.current_mA = drive.current_mA;
  for (std::size_t i = 0; i < plants_.size(); ++i) {
    const plant::Plant& plant = plants_[i];
    now_.plays[i] = {};
    plant.rig().effects.wheel_m(0.0, now_.plays[i]);
    now_.held[i] = {.reference_pressure_Pa = reference_Pa(i, drive)};
    now_.flows[i] = {.state = plant.at_rest(now_.held[i])};
    now_.flows[i].ledger = plant.opened(now_.flows[i].state);
    if (plant.has_events())
      now_.held[i].slip = plant.slip_from_rest(now_.flows[i].state, now_.flows[i].memory, now_.held[i]);
  }
  read();
}

void Ride::hold(const Drive& drive, double until_s) {
  if (!(until_s > now_.time_s)) throw std::invalid_argument("a ride goes forward in time");
  for (std::size_t i = 0; i < plants_.size(); ++i) {
    const plant::Plant& plant = plants_[i];
    plant::Held& held = now_.held[i];
    held.reference_pressure_Pa = reference_Pa(i, drive);
    held.current_speed_mA_per_s = (drive.current_mA - now_.current_mA) / (until_s - now_.time_s);
    // The level may have jumped with the current's speed (T 4.6): a load that stuck may be free now.
    if (plant.has_events() && held.slip == plant::Slip::sticking)
      held.slip = plant.slip_from_rest(now_.flows[i].state, now_.flows[i].memory, held);
  }
  now_.current_mA = drive.current_mA;
  now_.until_s = until_s;
}

std::span<const Reading> Ride::advance() {
  if (flock_)
    flock_->advance(now_.flows, now_.held, now_.time_s, now_.until_s);
  else
    for (std::size_t i = 0; i < plants_.size(); ++i)
      integrators_[i]->advance(now_.flows[i], now_.held[i], now_.time_s, now_.until_s);
  now_.time_s = now_.until_s;
  read();
  return now_.readings;
}

void Ride::read() {
  for (std::size_t i = 0; i < plants_.size(); ++i) {
    const plant::Rig& rig = plants_[i].rig();
    const plant::State<double>& state = now_.flows[i].state;
    const double rise_m = state.joint.contraction_ratio * rig.muscle.rest_length_m;
    now_.readings[i] = {rig.effects.wheel_m(rise_m, now_.plays[i]), state.side.muscle_pressure_Pa};
  }
}

engine::Counters Ride::counters() const {
  return integrators_.empty() ? engine::Counters{} : integrators_.front()->counters();
}

void Ride::open_ledger() {
  for (std::size_t i = 0; i < plants_.size(); ++i)
    now_.flows[i].ledger = plants_[i].opened(now_.flows[i].state);
}

Ride::Saved Ride::save() const {
  Saved saved = now_;
  saved.paces.clear();
  if (flock_) saved.paces.push_back(flock_->pace());
  for (const auto& integrator : integrators_) saved.paces.push_back(integrator->pace());
  return saved;
}

void Ride::restore(const Saved& saved) {
  now_ = saved;
  if (flock_) flock_->resume(saved.paces.front());
  for (std::size_t i = 0; i < integrators_.size(); ++i) integrators_[i]->resume(saved.paces[i]);
}

}  // namespace mckibben::ride
