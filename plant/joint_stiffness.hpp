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
  constexpr double shift = 1e-5;  // contraction ratio of muscle 1
  const double radius_m = plant.rig().joint.wheel_radius_m;
  const auto at = [&](double by) {
    State<double> turned = state;
    turned.joint.contraction_ratio += by;
    return plant.moment(turned, memory, held);
  };
  const Moment<double> less = at(-shift), more = at(shift);
  const auto pull_N = [](const SideMoment<double>& side) {
    return side.braid_force_N + side.stop_force_N + side.effects_pull_N - side.pull_on_load_N;
  };
  const double way_m = 2.0 * shift * plant.rig().muscle.rest_length_m;
  if (!plant.side().stretches() && !plant.opposite()->stretches())
    return (radius_m * (pull_N(less) - pull_N(less.opposite)) -
            radius_m * (pull_N(more) - pull_N(more.opposite))) /
           (way_m / radius_m);
  const auto N_per_m = [&](double difference_N, const Side& side) {
    const double muscle = difference_N / way_m, cord = side.rig().muscle.cord.stiffness_N_per_m;
    return side.stretches() ? muscle * cord / (muscle + cord) : muscle;  // springs in a row
  };
  return radius_m * radius_m *
         (N_per_m(pull_N(less) - pull_N(more), plant.side()) +
          N_per_m(pull_N(more.opposite) - pull_N(less.opposite), *plant.opposite()));
}

}  // namespace mckibben::plant
