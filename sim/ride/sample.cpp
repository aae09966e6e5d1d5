// What there is to see of a rig; see the header.
#include <plant/instruments.hpp>
#include <plant/joint_stiffness.hpp>
#include <sim/ride/sample.hpp>

namespace mckibben::ride {

plant::Sample sample_of(const Rider& rider, std::int64_t counts, const SensorNoise& noise) {
  const plant::Plant& plant = rider.plant();
  const plant::Rig& rig = plant.rig();
  const plant::State<double>& state = rider.now.flow.state;
  const Drive& drive = rider.now.drive;
  const Reading& reading = rider.now.reading;
  const plant::Moment<double> now = rider.moment();
  plant::Sample row;
  const auto write = [&](plant::SideSample& to, const plant::Side& side, const Command& command,
                         double contraction_ratio, const plant::SideMoment<double>& forces, double shown_Pa) {
    to.current_mA = command.current_mA;
    to.reference_Pa = side.reference_pressure_Pa(command.current_mA);
    to.contraction_ratio = contraction_ratio;
    to.braid_force_N = forces.braid_force_N;
    to.friction_force_N = forces.friction_force_N;
    to.effects_pull_N = forces.effects_pull_N;
    to.cord_force_N = forces.cord_force_N();
    to.inflow_kg_per_s = forces.hose_flow;
    to.gauge_Pa = plant::gauge_reading_Pa(rig.gauge, shown_Pa);
  };
  const double counted = static_cast<double>(counts), height_m = plant::count_height_m(rig);
  const double length_m = rig.muscle.rest_length_m, radius_m = rig.joint.wheel_radius_m;
  row.time_s = rider.now.time_s;
  row.state = state;
  row.counts = counts;
  row.misread_ratio = reading.misread_m / length_m;
  write(row, plant.side(), drive, state.joint.contraction_ratio, now,
        reading.muscle_pressure_Pa + noise.gauge_Pa);
  if (!plant.opposite()) {
    row.read_ratio = counted * (height_m / length_m);
    row.cell_N = plant::cell_reading_N(rig.load_cell, row.cord_force_N, noise.cell_N);
    return row;
  }
  write(row.opposite, *plant.opposite(), drive.opposite, plant.opposite_stroke(state).contraction_ratio,
        now.opposite, reading.opposite_pressure_Pa + noise.opposite_gauge_Pa);
  row.read_angle_rad = counted * height_m / radius_m;
  row.angle_rad = plant.angle_rad(state.joint.contraction_ratio);
  row.angle_speed_rad_per_s = length_m / radius_m * state.joint.contraction_speed_per_s;
  row.torque_N_m = radius_m * (row.cord_force_N - row.opposite.cord_force_N);
  row.stiffness_N_m_per_rad =
      plant::joint_stiffness_N_m_per_rad(plant, state, rider.now.flow.memory, rider.now.held);
  return row;
}

}  // namespace mckibben::ride
