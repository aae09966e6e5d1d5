// The order of an instant; see the header.
#include <algorithm>
#include <stdexcept>

#include <sim/ride/ride.hpp>

namespace mckibben::ride {

bool can_share_steps(std::span<const Hanging> rigs, solver::Method method) {
  return method != solver::Method::cvode &&
         std::none_of(rigs.begin(), rigs.end(), [](const Hanging& hanging) {
           return hanging.rig.friction.memory == plant::FrictionMemory::coulomb;
         });
}

Ride::Ride(std::span<const Hanging> rigs, const solver::Settings& settings, bool keep_ledger)
    : settings_(settings),
      together_(rigs.size() > 1 && can_share_steps(rigs, settings.method)),
      keep_ledger_(keep_ledger) {
  if (rigs.empty() || rigs.size() > engine::Flock::most)
    throw std::invalid_argument("a ride carries 1 to 8 rigs");
  for (const Hanging& hanging : rigs) add({hanging.rig, hanging.load_kg});
  make_integrators();
}

Ride::Ride(const Paired& pair, const solver::Settings& settings, bool keep_ledger)
    : settings_(settings), together_(false), keep_ledger_(keep_ledger) {
  add({pair.rig, pair.opposite, pair.link});
  make_integrators();
}

void Ride::add(const plant::Plant& plant) {
  plants_.push_back(plant);
  now_.flows.emplace_back();
  now_.held.emplace_back();
  now_.plays.emplace_back();
  now_.opposite_plays.emplace_back();
  now_.readings.emplace_back();
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

double Ride::reference_Pa(const plant::Side& side, const Command& command, plant::Effects::Plays& plays) {
  const double wanted_Pa = side.reference_pressure_Pa(command.current_mA + command.stray_current_mA);
  return side.rig().effects.reference_Pa(wanted_Pa, plays) + command.stray_pressure_Pa;
}

void Ride::start(const Drive& drive, double at_s) {
  now_.time_s = at_s;
  now_.drive = drive;
  for (std::size_t i = 0; i < plants_.size(); ++i) {
    const plant::Plant& plant = plants_[i];
    plant::Held& held = now_.held[i] = {};
    now_.plays[i] = now_.opposite_plays[i] = {};
    plant.rig().effects.wheel_m(0.0, now_.plays[i]);
    const auto full = [](const plant::Side& side, const Command& command, plant::Effects::Plays& plays) {
      return command.muscle_pressure_Pa.value_or(reference_Pa(side, command, plays));
    };
    held.reference_pressure_Pa = full(plant.side(), drive, now_.plays[i]);
    if (plant.opposite())
      held.opposite.reference_pressure_Pa = full(*plant.opposite(), drive.opposite, now_.opposite_plays[i]);
    held.length_is_given = drive.contraction_ratio.has_value();
    engine::Flow& flow = now_.flows[i] = {.state = plant.at_rest(held)};
    if (drive.contraction_ratio) flow.state.joint.contraction_ratio = *drive.contraction_ratio;
    flow.ledger = plant.opened(flow.state);
    if (plant.has_events() && !held.length_is_given)
      held.slip = plant.slip_from_rest(flow.state, flow.memory, held);
  }
  read();
}

void Ride::hold_side(const plant::Side& side, const Command& before, const Command& now, double pressure_Pa,
                     double length_s, plant::Effects::Plays& plays, plant::HeldSide& held) {
  held.reference_pressure_Pa = reference_Pa(side, now, plays);
  held.current_speed_mA_per_s = (now.current_mA - before.current_mA) / length_s;
  held.pressure_rate_Pa_per_s.reset();
  if (now.muscle_pressure_Pa)
    held.pressure_rate_Pa_per_s = (*now.muscle_pressure_Pa - pressure_Pa) / length_s;
}

void Ride::hold(const Drive& drive, double until_s) {
  if (!(until_s > now_.time_s)) throw std::invalid_argument("a ride goes forward in time");
  const double length_s = until_s - now_.time_s;
  for (std::size_t i = 0; i < plants_.size(); ++i) {
    const plant::Plant& plant = plants_[i];
    plant::Held& held = now_.held[i];
    engine::Flow& flow = now_.flows[i];
    hold_side(plant.side(), now_.drive, drive, flow.state.side.muscle_pressure_Pa, length_s, now_.plays[i],
              held);
    if (plant.opposite())
      hold_side(*plant.opposite(), now_.drive.opposite, drive.opposite,
                flow.state.opposite.muscle_pressure_Pa, length_s, now_.opposite_plays[i], held.opposite);
    held.length_is_given = drive.contraction_ratio.has_value();
    if (drive.contraction_ratio) {
      const double speed_per_s = (*drive.contraction_ratio - flow.state.joint.contraction_ratio) / length_s;
      plant.take_speed(speed_per_s, flow.state, flow.ledger);
      // Threads that are pulled no further keep the force that they had.
      if (speed_per_s != 0.0) held.slip = speed_per_s > 0.0 ? plant::Slip::rising : plant::Slip::falling;
    } else if (plant.has_events() && held.slip == plant::Slip::sticking) {
      // The level may have jumped with the current's speed (T 4.6): a load that stuck may be free now.
      held.slip = plant.slip_from_rest(flow.state, flow.memory, held);
    }
  }
  now_.drive = drive;
  now_.until_s = until_s;
}

std::span<const Reading> Ride::advance() {
  if (flock_)
    flock_->advance(now_.flows, now_.held, now_.time_s, now_.until_s);
  else
    for (std::size_t i = 0; i < plants_.size(); ++i)
      integrators_[i]->advance(now_.flows[i], now_.held[i], now_.time_s, now_.until_s);
  now_.time_s = now_.until_s;
  arrive();
  read();
  return now_.readings;
}

void Ride::arrive() {
  const Drive& drive = now_.drive;
  for (engine::Flow& flow : now_.flows) {
    if (drive.contraction_ratio) flow.state.joint.contraction_ratio = *drive.contraction_ratio;
    if (drive.muscle_pressure_Pa) flow.state.side.muscle_pressure_Pa = *drive.muscle_pressure_Pa;
    if (drive.opposite.muscle_pressure_Pa)
      flow.state.opposite.muscle_pressure_Pa = *drive.opposite.muscle_pressure_Pa;
  }
}

void Ride::read() {
  for (std::size_t i = 0; i < plants_.size(); ++i) {
    const plant::Plant& plant = plants_[i];
    const plant::State<double>& state = now_.flows[i].state;
    const double turned =
        state.joint.contraction_ratio - (plant.opposite() ? plant.link().contraction_ratio : 0.0);
    const double rise_m = turned * plant.rig().muscle.rest_length_m;
    now_.readings[i] = {plant.rig().effects.wheel_m(rise_m, now_.plays[i]), state.side.muscle_pressure_Pa,
                        state.opposite.muscle_pressure_Pa};
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
