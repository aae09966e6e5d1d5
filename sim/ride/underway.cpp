// Bristles and memories from a balance; see the header.
#include <algorithm>

#include <sim/ride/underway.hpp>

namespace mckibben::ride {

// Each memory follows a straight law of its own: its rate at two values tells where it would be at rest.
void rest_memories(Rider& rider, const plant::State<double>& before, double off, const SomeMemories& which,
                   Muscle muscle) {
  const plant::Plant& plant = rider.plant();
  if (!plant.remembers()) return;
  engine::Flow& flow = rider.now.flow;
  const auto of_muscle = [&](plant::Memory<double>& memory) -> plant::SideMemory<double>& {
    return muscle == Muscle::first ? memory.side : memory.opposite;
  };
  const plant::SideMemory<double> none = of_muscle(flow.memory);
  const auto rates = [&](const plant::State<double>& state, const plant::SideMemory<double>& memory) {
    plant::Memory<double> whole = flow.memory;
    of_muscle(whole) = memory;
    const plant::Moment<double> moment = plant.moment(state, whole, rider.now.held);
    return muscle == Muscle::first ? moment.memory_rates : moment.opposite.memory_rates;
  };
  const auto at_rest = rates(before, none), now = rates(flow.state, none);
  // A cord's stretch and its end's speed rest by each other: they are no effect's.
  const auto slots =
      std::min(static_cast<std::size_t>(plant::carried(plant.memories())), plant::cord_stretch);
  for (std::size_t slot = 0; slot < slots; ++slot) {
    if (!which[slot]) continue;
    const double size = plant::memory_sizes[slot];
    plant::SideMemory<double> further = none;
    further[slot] += size;
    const double slope = (rates(flow.state, further)[slot] - now[slot]) / size;
    if (slope >= 0.0) continue;                     // of an effect that is switched off
    const bool clock = now[slot] == at_rest[slot];  // it runs whatever the rig does
    of_muscle(flow.memory)[slot] = none[slot] + off * size - (clock ? 0.0 : now[slot] / slope);
  }
}

namespace {

/// A cord that stretches is as long as the acceleration of the joint asks for, and stays so.
void stretch_cord(Rider& rider, double speed_m_per_s, double acceleration_m_per_s2) {
  plant::SideMemory<double>& memory = rider.now.flow.memory.side;
  memory[plant::cord_end_speed] = speed_m_per_s;
  const double slack = rider.moment().acceleration_m_per_s2;
  double& stretch_m = memory[plant::cord_stretch] = plant::memory_sizes[plant::cord_stretch];
  const double slope = (rider.moment().acceleration_m_per_s2 - slack) / stretch_m;
  stretch_m = std::max((acceleration_m_per_s2 - slack) / slope, 0.0);
}

/// The threads' bristles bend as far as the acceleration asks for, and friction allows.
void bend_bristles(Rider& rider, double acceleration_m_per_s2) {
  const plant::Plant& plant = rider.plant();
  engine::Flow& flow = rider.now.flow;
  const auto end_m_per_s2 = [&](const plant::Moment<double>& now) {  // of the muscle's end
    return now.stretches ? now.memory_rates[plant::cord_end_speed] : now.acceleration_m_per_s2;
  };
  const auto& friction = plant.rig().friction;
  double& bristle_m = flow.state.side.bristle_m;
  bristle_m = 0.0;
  const plant::Moment<double> straight = rider.moment();
  const double most_m = straight.friction_level_N / friction.bristle_stiffness_N_per_m;
  bristle_m = most_m;
  const double slope = (end_m_per_s2(rider.moment()) - end_m_per_s2(straight)) / most_m;
  bristle_m = std::clamp((acceleration_m_per_s2 - end_m_per_s2(straight)) / slope, -most_m, most_m);
}

}  // namespace

void set_off(Rider& rider, const Underway& seen) {
  const plant::Plant& plant = rider.plant();
  Rider::State& now = rider.now;
  plant::State<double>& state = now.flow.state;
  const plant::State<double> at_rest = state;
  const double length_m = plant.rig().muscle.rest_length_m;
  // What is seen was so long ago.
  const double late_s =
      plant.rig().effects.reading_delay_s() + plant.rig().sensors.position().late_s(now.time_s);
  now.rises = {};
  now.late.clear();
  const double stood_m = seen.rise_m - plant.rig().joint.reading_offset_m + seen.off_rise_m;
  now.rises.note(now.time_s - late_s, stood_m, seen.speed_m_per_s, now.time_s - late_s);
  const double gained_m_per_s = late_s * seen.acceleration_m_per_s2;
  const double rise_m = stood_m + late_s * (seen.speed_m_per_s + 0.5 * gained_m_per_s);
  const double speed_m_per_s = seen.speed_m_per_s + gained_m_per_s + seen.off_speed_m_per_s;
  const double acceleration_m_per_s2 = seen.acceleration_m_per_s2 + seen.off_acceleration_m_per_s2;
  state.joint = {rise_m / length_m, speed_m_per_s / length_m};
  now.held.given = now.drive.given();
  now.held.pressure_rate_Pa_per_s = 0.0;
  const bool asks = !now.drive.muscle_pressure_Pa && !plant.rig().valve.seals();
  if (!now.drive.muscle_pressure_Pa && seen.muscle_pressure_Pa) {
    state.side.muscle_pressure_Pa = plant.rig().effects.true_Pa(*seen.muscle_pressure_Pa);
    if (!now.drive.valve_pressure_Pa) state.side.valve_pressure_Pa = state.side.muscle_pressure_Pa;
  } else if (asks) {
    state.side.muscle_pressure_Pa += seen.off_muscle_Pa;
  }
  if (asks && !now.drive.valve_pressure_Pa) state.side.valve_pressure_Pa += seen.off_valve_Pa;
  if (plant.side().stretches()) stretch_cord(rider, speed_m_per_s, acceleration_m_per_s2);
  SomeMemories all;
  all.fill(true);
  rest_memories(rider, at_rest, seen.memories, all);
  if (plant.has_events())
    now.held.slip = state.joint.contraction_speed_per_s < 0.0 ? plant::Slip::falling : plant::Slip::rising;
  else
    bend_bristles(rider, acceleration_m_per_s2);
  rider.open_ledger();
  rider.look();
}

}  // namespace mckibben::ride
