// The order of an instant; see the header.
#include <stdexcept>

#include <sim/ride/rider.hpp>

namespace mckibben::ride {
namespace {

/// What the valve of a side is to follow. Pushes the plays on the way.
double reference_Pa(const plant::Side& side, const Command& command, plant::Effects::Plays& plays) {
  const double wanted_Pa = side.reference_pressure_Pa(command.current_mA + command.stray_current_mA);
  return side.rig().effects.reference_Pa(wanted_Pa, plays) + command.stray_pressure_Pa;
}

/// What is held of a side until the next instant, `length_s` away.
void hold_side(const plant::Side& side, const Command& before, const Command& now, double pressure_Pa,
               double length_s, plant::Effects::Plays& plays, plant::HeldSide& held) {
  held.reference_pressure_Pa = reference_Pa(side, now, plays);
  held.current_speed_mA_per_s = (now.current_mA - before.current_mA) / length_s;
  held.pressure_rate_Pa_per_s.reset();
  if (now.muscle_pressure_Pa)
    held.pressure_rate_Pa_per_s = (*now.muscle_pressure_Pa - pressure_Pa) / length_s;
}

/// Of a muscle whose length is given: what the bench says, by its zero.
double given_ratio(const plant::Rig& rig, double said) {
  return said + rig.joint.length_offset_m / rig.muscle.rest_length_m;
}

}  // namespace

void Rider::start(const Drive& drive, double at_s) {
  now = {.time_s = at_s, .until_s = at_s, .drive = drive};
  plant_.rig().effects.wheel_m(0.0, now.plays);
  const auto full = [](const plant::Side& side, const Command& command, plant::Effects::Plays& plays) {
    return command.muscle_pressure_Pa.value_or(reference_Pa(side, command, plays));
  };
  plant::Held& held = now.held;
  held.reference_pressure_Pa = full(plant_.side(), drive, now.plays);
  if (plant_.opposite())
    held.opposite.reference_pressure_Pa = full(*plant_.opposite(), drive.opposite, now.opposite_plays);
  held.length_is_given = drive.contraction_ratio.has_value();
  engine::Flow& flow = now.flow = {.state = plant_.at_rest(held)};
  if (drive.contraction_ratio)
    flow.state.joint.contraction_ratio = given_ratio(plant_.rig(), *drive.contraction_ratio);
  flow.ledger = plant_.opened(flow.state);
  if (plant_.has_events() && !held.length_is_given)
    held.slip = plant_.slip_from_rest(flow.state, flow.memory, held);
  look();
}

void Rider::hold(const Drive& drive, double until_s) {
  if (!(until_s > now.time_s)) throw std::invalid_argument("a ride goes forward in time");
  const double length_s = until_s - now.time_s;
  plant::Held& held = now.held;
  engine::Flow& flow = now.flow;
  hold_side(plant_.side(), now.drive, drive, flow.state.side.muscle_pressure_Pa, length_s, now.plays, held);
  if (plant_.opposite())
    hold_side(*plant_.opposite(), now.drive.opposite, drive.opposite, flow.state.opposite.muscle_pressure_Pa,
              length_s, now.opposite_plays, held.opposite);
  held.length_is_given = drive.contraction_ratio.has_value();
  if (drive.contraction_ratio) {
    const double wanted = given_ratio(plant_.rig(), *drive.contraction_ratio);
    const double speed_per_s = (wanted - flow.state.joint.contraction_ratio) / length_s;
    plant_.take_speed(speed_per_s, flow.state, flow.ledger);
    // Threads that are pulled no further keep the force that they had.
    if (speed_per_s != 0.0) held.slip = speed_per_s > 0.0 ? plant::Slip::rising : plant::Slip::falling;
  } else if (plant_.has_events() && held.slip == plant::Slip::sticking) {
    // The level may have jumped with the current's speed (T 4.6): a load that stuck may be free now.
    held.slip = plant_.slip_from_rest(flow.state, flow.memory, held);
  }
  now.drive = drive;
  now.until_s = until_s;
}

void Rider::arrive() {
  now.time_s = now.until_s;
  // The joint at the length and the muscles at the pressures that were given, to the last bit.
  plant::State<double>& state = now.flow.state;
  if (now.drive.contraction_ratio)
    state.joint.contraction_ratio = given_ratio(plant_.rig(), *now.drive.contraction_ratio);
  if (now.drive.muscle_pressure_Pa) state.side.muscle_pressure_Pa = *now.drive.muscle_pressure_Pa;
  if (now.drive.opposite.muscle_pressure_Pa)
    state.opposite.muscle_pressure_Pa = *now.drive.opposite.muscle_pressure_Pa;
  look();
}

void Rider::look() {
  const plant::State<double>& state = now.flow.state;
  const double turned =
      state.joint.contraction_ratio - (plant_.opposite() ? plant_.link().contraction_ratio : 0.0);
  const double rise_m = turned * plant_.rig().muscle.rest_length_m;
  now.reading = {plant_.rig().effects.wheel_m(rise_m, now.plays), state.side.muscle_pressure_Pa,
                 state.opposite.muscle_pressure_Pa};
}

}  // namespace mckibben::ride
