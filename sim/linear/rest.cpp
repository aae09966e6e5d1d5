// Rides there, and has Newton's method go on; see the header.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/LU>

#include <sim/engine/linear.hpp>
#include <sim/linear/rest.hpp>

namespace mckibben::linear {

plant::Rig without_friction(plant::Rig rig) {
  const auto loosen = [](plant::Friction& friction) {
    friction.memory = plant::FrictionMemory::lugre;
    friction.bristle_stiffness_N_per_m = 0.0;
    friction.floor_N = 1.0;  // bristles without any would bend infinitely fast
  };
  loosen(rig.friction);
  rig.effects.get<plant::GuideFriction>() = {};
  if (plant::Pair* pair = rig.pair()) loosen(pair->opposite.friction);
  return rig;
}

Settled::Settled(const plant::Rig& rig, double load_kg, const controllers::Command& command)
    : ride_({rig, load_kg}, rig.integrator) {
  constexpr double longest_s = 600.0, ratio_in_a_second = 1e-7, Pa_in_a_second = 1.0;
  ride::Drive drive;
  drive.current_mA = command.current_mA;
  drive.opposite.current_mA = command.opposite_mA;
  ride_.start(drive, 0.0);
  const long second = std::max(std::lround(1.0 / rig.tick_s), 1L);
  const auto longest = static_cast<long>(std::max(longest_s, rig.settling_time_s) / rig.tick_s);
  plant::State<double> before = state();
  for (long tick = 1; tick <= longest; ++tick) {
    ride_.step(drive, static_cast<double>(tick) * rig.tick_s);
    if (tick % second != 0) continue;
    const plant::State<double> now = state();
    settled = std::abs(now.joint.contraction_ratio - before.joint.contraction_ratio) < ratio_in_a_second &&
              std::abs(now.side.muscle_pressure_Pa - before.side.muscle_pressure_Pa) < Pa_in_a_second;
    before = now;
    if (settled && static_cast<double>(tick) * rig.tick_s >= rig.settling_time_s) break;
  }
}

bool calm(ride::Ride& ride, const std::array<double, 2>& commands) {
  engine::Flow& flow = ride.rider().now.flow;
  plant::Held held = ride.held();
  held.slip = plant::Slip::rising;  // of friction that sticks there are no slopes
  flow.state.joint.contraction_speed_per_s = 0.0;
  const auto part = [&](const std::string& name) -> double* {
    const auto of = [&](const std::string& suffix, plant::SideState<double>& state,
                        plant::SideMemory<double>& memory) -> double* {
      if (name == "valve_pressure" + suffix + "_Pa") return &state.valve_pressure_Pa;
      if (name == "muscle_pressure" + suffix + "_Pa") return &state.muscle_pressure_Pa;
      if (name == "regulator_error" + suffix + "_Pa") return &memory[plant::regulator_memory];
      return name == "valve_lag" + suffix ? &memory[lag_slot] : nullptr;
    };
    if (!ride.plant().opposite()) return of("", flow.state.side, flow.memory.side);
    double* one = of("_1", flow.state.side, flow.memory.side);
    return one != nullptr ? one : of("_2", flow.state.opposite, flow.memory.opposite);
  };
  for (int step = 0; step < 20; ++step) {
    const engine::Linear now = engine::linearise(ride.plant(), flow, held, commands);
    std::vector<Eigen::Index> air;
    for (std::size_t i = 0; i < now.states.size(); ++i)
      if (part(now.states[i].name) != nullptr) air.push_back(static_cast<Eigen::Index>(i));
    const Eigen::VectorXd moves = now.A(air, air).fullPivLu().solve(-now.rate(air));
    for (std::size_t i = 0; i < air.size(); ++i)
      *part(now.states[static_cast<std::size_t>(air[i])].name) += moves[static_cast<Eigen::Index>(i)];
    if (moves.lpNorm<Eigen::Infinity>() < hardly_Pa) return true;
  }
  return false;
}

}  // namespace mckibben::linear
