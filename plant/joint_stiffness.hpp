// How stiff two muscles make their joint: what they add to the torque against a turn while their pressures
// are kept. Threads' friction, which has no slope of its own, and the link's weight are left out.
#pragma once

#include <plant/plant.hpp>

namespace mckibben::plant {

/// -dM/dtheta [N m/rad] of a pair, with M = R (T_1 - T_2) of braids, stops and effects, by a central
/// difference; 0 of one muscle. For states inside `in_domain`.
inline double joint_stiffness_N_m_per_rad(const Plant& plant, const State<double>& state,
                                          const Memory<double>& memory, const Held& held) {
  if (!plant.opposite()) return 0.0;
  constexpr double shift = 1e-5;  // contraction ratio
  const double radius_m = plant.rig().joint.wheel_radius_m;
  const auto torque_N_m = [&](double by) {
    State<double> turned = state;
    turned.joint.contraction_ratio += by;
    const Moment<double> now = plant.moment(turned, memory, held);
    const auto pull_N = [](const SideMoment<double>& side) {
      return side.braid_force_N + side.stop_force_N + side.effects_pull_N - side.pull_on_load_N;
    };
    return radius_m * (pull_N(now) - pull_N(now.opposite));
  };
  const double rad = 2.0 * shift * plant.rig().muscle.rest_length_m / radius_m;
  return (torque_N_m(-shift) - torque_N_m(shift)) / rad;
}

}  // namespace mckibben::plant
