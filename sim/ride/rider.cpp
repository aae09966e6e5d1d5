// The order of an instant; see the header.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <sim/engine/failure.hpp>
#include <sim/ride/rider.hpp>
#include <sim/ride/underway.hpp>

namespace mckibben::ride {
namespace {

/// What the valve of a side is to follow. Pushes the plays on the way.
double reference_Pa(const plant::Side& side, const Command& command, plant::Effects::Plays& plays) {
  const double wanted_Pa = side.reference_pressure_Pa(command.current_mA + command.stray_current_mA);
  return side.rig().effects.reference_Pa(wanted_Pa, plays) + command.stray_pressure_Pa;
}

/// A given pressure is what a gauge showed.
void correct_gauge(const plant::Side& side, Command& command) {
  if (command.muscle_pressure_Pa)
    command.muscle_pressure_Pa = side.rig().effects.true_Pa(*command.muscle_pressure_Pa);
}
Drive corrected(const plant::Plant& plant, Drive drive) {
  correct_gauge(plant.side(), drive);
  if (plant.opposite()) correct_gauge(*plant.opposite(), drive.opposite);
  return drive;
}

/// What a side's valve has from this instant on: the command, or where commands are late one from before.
void feel(const plant::Side& side, Command command, double now_s, PastCommands& past, Switches& valves,
          plant::Effects::Plays& plays, plant::HeldSide& held) {
  if (const double late_s = side.rig().effects.command_delay_s(); late_s > 0.0) {
    const Given& felt = past.felt(now_s, late_s);
    command.current_mA = felt.current_mA;
    held.current_speed_mA_per_s = felt.speed_mA_per_s;
  }
  held.reference_pressure_Pa = reference_Pa(side, command, plays);
  if (side.rig().valve.is_on_off())
    valves.follow(side, command.current_mA + command.stray_current_mA, now_s, held);
}

/// What is held of a side until the next instant, `length_s` away.
void hold_side(const plant::Side& side, const Command& before, const Command& now, double now_s,
               const plant::SideState<double>& state, double length_s, PastCommands& past, Switches& valves,
               plant::Effects::Plays& plays, plant::HeldSide& held) {
  held.current_speed_mA_per_s = (now.current_mA - before.current_mA) / length_s;
  if (side.rig().effects.command_delay_s() > 0.0)
    past.give({now_s, now.current_mA, held.current_speed_mA_per_s});
  feel(side, now, now_s, past, valves, plays, held);
  held.given = now.given();
  if (side.rig().valve.seals()) {
    held.fills = held.given == plant::GivenPressure::muscle ? 1.0 : 0.0;
    held.given = plant::GivenPressure::none;
  }
  if (now.given() == plant::GivenPressure::muscle)
    held.pressure_rate_Pa_per_s = (*now.muscle_pressure_Pa - state.muscle_pressure_Pa) / length_s;
  else if (held.given == plant::GivenPressure::valve)
    held.pressure_rate_Pa_per_s = (*now.valve_pressure_Pa - state.valve_pressure_Pa) / length_s;
}

/// A given pressure is reached to the last bit.
void take_given(const Command& drive, plant::SideState<double>& state) {
  if (drive.muscle_pressure_Pa)
    state.muscle_pressure_Pa = *drive.muscle_pressure_Pa;
  else if (drive.valve_pressure_Pa)
    state.valve_pressure_Pa = *drive.valve_pressure_Pa;
}

/// What acts on the whole rig until the next instant.
void hold_outside(const plant::Rig& rig, const Drive& drive, plant::Held& held) {
  held.length_is_given = drive.contraction_ratio.has_value();
  held.joint_force_N = drive.joint_force_N;
  const double own_Pa = rig.valve.supply_pressure_Pa;
  held.supply_above_Pa = held.opposite.supply_above_Pa = drive.supply_pressure_Pa.value_or(own_Pa) - own_Pa;
}

/// Of a muscle whose length is given: what the bench says, by its zero.
double given_ratio(const plant::Rig& rig, double said) {
  return said + rig.joint.length_offset_m / rig.muscle.rest_length_m;
}

}  // namespace

Drive settling(Drive drive, const plant::Rig& rig) {
  if (rig.valve.seals() && !drive.muscle_pressure_Pa) drive.muscle_pressure_Pa = rig.valve.fill_pressure_Pa;
  return drive;
}

void Rider::start(const Drive& given, double at_s) {
  const Drive drive = corrected(plant_, given);
  now = {.time_s = at_s, .until_s = at_s, .drive = drive};
  now.commands.begin(drive.current_mA);
  now.opposite_commands.begin(drive.opposite.current_mA);
  plant_.rig().effects.wheel_m(0.0, now.plays);
  const auto full = [](const plant::Side& side, const Command& command, plant::Effects::Plays& plays) {
    // Valves that are open or shut keep no pressure: such a rig begins vented.
    const plant::Valve& valve = side.rig().valve;
    const double wanted = reference_Pa(side, command, plays), reference = valve.is_on_off() ? 0.0
                                                                          : valve.seals()
                                                                              ? valve.fill_pressure_Pa
                                                                              : wanted;
    return command.muscle_pressure_Pa.value_or(command.valve_pressure_Pa.value_or(reference));
  };
  plant::Held& held = now.held;
  held.reference_pressure_Pa = full(plant_.side(), drive, now.plays);
  if (plant_.opposite())
    held.opposite.reference_pressure_Pa = full(*plant_.opposite(), drive.opposite, now.opposite_plays);
  hold_outside(plant_.rig(), drive, held);
  engine::Flow& flow = now.flow = {.state = plant_.at_rest(held)};
  if (drive.contraction_ratio) {
    // A muscle that a bench has held at a length has got used to it.
    const plant::State<double> at_rest_length = flow.state;
    flow.state.joint.contraction_ratio = given_ratio(plant_.rig(), *drive.contraction_ratio);
    SomeMemories all;
    all.fill(true);
    rest_memories(*this, at_rest_length, 0.0, all);
  }
  flow.ledger = plant_.opened(flow.state, flow.memory);
  if (plant_.has_events() && !held.length_is_given)
    held.slip = plant_.slip_from_rest(flow.state, flow.memory, held);
  look();
}

void Rider::hold(const Drive& given, double until_s) {
  if (!(until_s > now.time_s)) throw std::invalid_argument("time must increase");
  const Drive drive = corrected(plant_, given);
  const double length_s = until_s - now.time_s;
  plant::Held& held = now.held;
  engine::Flow& flow = now.flow;
  hold_side(plant_.side(), now.drive, drive, now.time_s, flow.state.side, length_s, now.commands,
            now.switches, now.plays, held);
  if (plant_.opposite())
    hold_side(*plant_.opposite(), now.drive.opposite, drive.opposite, now.time_s, flow.state.opposite,
              length_s, now.opposite_commands, now.opposite_switches, now.opposite_plays, held.opposite);
  hold_outside(plant_.rig(), drive, held);
  if (drive.contraction_ratio) {
    const double wanted = given_ratio(plant_.rig(), *drive.contraction_ratio);
    const double speed_per_s = (wanted - flow.state.joint.contraction_ratio) / length_s;
    plant_.take_speed(speed_per_s, flow.state, flow.ledger);
    // Threads that are pulled no further keep the force that they had.
    if (speed_per_s != 0.0) held.slip = speed_per_s > 0.0 ? plant::Slip::rising : plant::Slip::falling;
  } else {
    judge_slip();
  }
  now.drive = drive;
  now.until_s = until_s;
  if (const plant::Sensor* cell = plant_.rig().sensors.of(plant::Sensed::force); cell && cell->is_late())
    for (std::size_t muscle = 1; muscle <= (plant_.opposite() ? 2U : 1U); ++muscle)
      now.reading.of(muscle)[plant::Sensed::force] =
          seen(plant::Sensed::force, muscle, std::max(cord_force_N(muscle), 0.0));
}

/// The level may have jumped with the current's speed (T 4.6): a load that stuck may be free now.
void Rider::judge_slip() {
  if (plant_.has_events() && now.held.slip == plant::Slip::sticking && !now.held.length_is_given)
    now.held.slip = plant_.slip_from_rest(now.flow.state, now.flow.memory, now.held);
}

double Rider::next_s() const {
  const auto next_s = [&](const plant::Side& side, const PastCommands& past, const Switches& valves) {
    const double late_s = side.rig().effects.command_delay_s();
    const double felt_s = late_s > 0.0 ? past.next_s(now.time_s, late_s) : now.until_s;
    return std::min(felt_s, valves.next_s());
  };
  double soonest_s = next_s(plant_.side(), now.commands, now.switches);
  if (plant_.opposite())
    soonest_s = std::min(soonest_s, next_s(*plant_.opposite(), now.opposite_commands, now.opposite_switches));
  return soonest_s < now.until_s - same_instant_s ? soonest_s : now.until_s;
}

bool Rider::arrive(double at_s) {
  now.time_s = at_s;
  if (at_s < now.until_s) {
    feel(plant_.side(), now.drive, at_s, now.commands, now.switches, now.plays, now.held);
    if (plant_.opposite())
      feel(*plant_.opposite(), now.drive.opposite, at_s, now.opposite_commands, now.opposite_switches,
           now.opposite_plays, now.held.opposite);
    judge_slip();
    return false;
  }
  // The joint at the length and the muscles at the pressures that were given, to the last bit.
  plant::State<double>& state = now.flow.state;
  if (now.drive.contraction_ratio)
    state.joint.contraction_ratio = given_ratio(plant_.rig(), *now.drive.contraction_ratio);
  take_given(now.drive, state.side);
  take_given(now.drive.opposite, state.opposite);
  look();
  return true;
}

double next_s(std::span<const Rider> riders) {
  double soonest_s = riders.front().next_s();
  for (const Rider& rider : riders) soonest_s = std::min(soonest_s, rider.next_s());
  return soonest_s;
}

bool arrive(std::span<Rider> riders, double at_s) {
  bool there = true;
  for (Rider& rider : riders) there = rider.arrive(at_s) && there;
  return there;
}

void Rider::look() {
  const plant::State<double>& state = now.flow.state;
  const double true_rise_m = plant_.shown_m(state.joint.contraction_ratio);
  double rise_m = true_rise_m;
  const plant::Sensor& sensor = plant_.rig().sensors.position();
  if (const double effect_s = plant_.rig().effects.reading_delay_s(); effect_s > 0.0 || sensor.is_late()) {
    const double then_s = now.time_s - (effect_s + sensor.late_s(now.time_s));
    now.rises.note(now.time_s, rise_m, plant_.shown_speed_m_per_s(state.joint), then_s);
    rise_m = now.rises.at(then_s);
  }
  const plant::Stroke<double> stroke{state.joint.contraction_ratio, state.joint.contraction_speed_per_s};
  const double shift_m = plant_.side().reading_shift_m(stroke, state.side, now.flow.memory.side, now.held);
  now.reads = std::isfinite(shift_m);
  if (now.reads) rise_m += shift_m;
  const double wheel_m =
      plant_.rig().effects.wheel_m(rise_m, now.plays) + plant_.rig().joint.reading_offset_m;
  using enum plant::Sensed;
  now.reading.wheel_m = wheel_m;
  now.reading.misread_m = wheel_m - true_rise_m;
  const auto gauges = [&](std::size_t muscle, const plant::Rig& rig, const plant::SideState<double>& side) {
    plant::BySensed& shown = now.reading.of(muscle);
    shown[muscle_pressure] = rig.effects.shown_Pa(seen(muscle_pressure, muscle, side.muscle_pressure_Pa));
    shown[valve_pressure] = seen(valve_pressure, muscle, side.valve_pressure_Pa);
  };
  gauges(1, plant_.rig(), state.side);
  if (plant_.opposite()) gauges(2, plant_.opposite()->rig(), state.opposite);
}

double Rider::cord_force_N(std::size_t muscle) const {
  const plant::Moment<double> all = moment();
  return muscle == 2 ? all.opposite.cord_force_N() : all.cord_force_N();
}

double Rider::seen(plant::Sensed sensed, std::size_t muscle, double value) {
  const plant::Sensor* const sensor = plant_.rig().sensors.of(sensed);
  if (sensor == nullptr || !sensor->is_late()) return value;
  constexpr double no_slope = std::numeric_limits<double>::quiet_NaN();
  constexpr std::size_t signals = names(plant::Sensed{}).size();
  now.late.resize(2 * signals);
  PastValues& past = now.late[(muscle - 1) * signals + static_cast<std::size_t>(sensed)];
  const double then_s = now.time_s - sensor->late_s(now.time_s);
  past.note(now.time_s, value, no_slope, then_s);
  return past.at(then_s);
}

void Rider::require_reading() const {
  if (now.reads) return;
  throw engine::NumericalFailure(
      now.time_s, now.flow.state,
      "what the encoder reads is not a number here: look at the laws of effects.hypotheses that add to it");
}

}  // namespace mckibben::ride
