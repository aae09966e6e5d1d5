// What there is to see of a rig; see the header.
#include <algorithm>

#include <plant/instruments.hpp>
#include <plant/joint_stiffness.hpp>
#include <sim/ride/sample.hpp>

namespace mckibben::ride {

namespace {

/// What the sensors of a muscle show.
void show(const plant::Sensors& sensors, const plant::Sample& row, std::size_t muscle, const Reading& reading,
          const plant::BySensed& noise, plant::BySensed& shown) {
  for (const auto& [sensed, key] : names(plant::Sensed{})) {
    if (sensed == plant::Sensed::contraction) continue;
    const plant::Sensor* const sensor = sensors.of(sensed);
    const bool now = sensed == plant::Sensed::force && !(sensor && sensor->is_late());
    // A cord that would push is slack.
    const double value = now ? std::max(row.side(muscle).cord_force_N, 0.0) : reading.of(sensed, muscle);
    shown[sensed] = plant::shown(sensor, value + noise[sensed]);
  }
}

}  // namespace

plant::Sample sample_of(const Rider& rider, std::int64_t counts, const SensorNoise& noise) {
  const plant::Plant& plant = rider.plant();
  const plant::Rig& rig = plant.rig();
  const plant::State<double>& state = rider.now.flow.state;
  const plant::Memory<double>& memory = rider.now.flow.memory;
  const Drive& drive = rider.now.drive;
  const Reading& reading = rider.now.reading;
  const plant::Moment<double> now = rider.moment();
  plant::Sample row;
  const auto write = [&](plant::SideSample& to, const plant::Side& side, const Command& command,
                         const plant::SideMoment<double>& forces,
                         const plant::SideMemory<double>& remembered) {
    to.current_mA = command.current_mA;
    to.reference_Pa = side.reference_pressure_Pa(command.current_mA);
    to.contraction_ratio = forces.stroke.contraction_ratio;
    if (forces.stretches) {
      to.cord_stretch_m = remembered[plant::cord_stretch];
      to.cord_end_m_per_s = remembered[plant::cord_end_speed];
    }
    to.braid_force_N = forces.braid_force_N;
    to.friction_force_N = forces.friction_force_N;
    to.effects_pull_N = forces.effects_pull_N;
    to.cord_force_N = forces.cord_force_N();
    to.inflow_kg_per_s = forces.hose_flow;
  };
  const double counted = static_cast<double>(counts), height_m = plant::count_height_m(rig);
  const double length_m = rig.muscle.rest_length_m, radius_m = rig.joint.wheel_radius_m;
  row.time_s = rider.now.time_s;
  row.state = state;
  row.counts = counts;
  row.misread_ratio = reading.misread_m / length_m;
  write(row, plant.side(), drive, now, memory.side);
  row.supply_Pa = drive.supply_pressure_Pa.value_or(rig.valve.supply_pressure_Pa) -
                  rig.effects.supply_drop_Pa(memory.side);
  row.joint_force_N = drive.joint_force_N;
  row.joint_torque_N_m = 0.0 - radius_m * drive.joint_force_N;  // of none 0, not -0
  show(rig.sensors, row, 1, reading, noise[0], row.shown);
  if (!plant.has_angle()) {
    row.read_ratio = counted * (height_m / length_m);
    return row;
  }
  row.read_angle_rad = counted * height_m / radius_m;
  row.angle_rad = plant.angle_rad(state.joint.contraction_ratio);
  row.angle_speed_rad_per_s = plant.angle_speed_rad_per_s(state.joint);
  row.torque_N_m = plant.arm_m(state.joint.contraction_ratio) * row.cord_force_N;
  if (!plant.opposite()) return row;
  write(row.opposite, *plant.opposite(), drive.opposite, now.opposite, memory.opposite);
  show(rig.sensors, row, 2, reading, noise[1], row.opposite.shown);
  row.torque_N_m = radius_m * (row.cord_force_N - row.opposite.cord_force_N);
  row.stiffness_N_m_per_rad = plant::joint_stiffness_N_m_per_rad(plant, state, memory, rider.now.held);
  return row;
}

}  // namespace mckibben::ride
