// What moves the joint: a hanging load, a lever, or the link that two muscles turn. Part of plant.hpp, which
// includes it.
#pragma once

#include <plant/plant.hpp>

namespace mckibben::plant {

// theta'' = torque/I, and x' = r theta': what the lever feels is felt at the cord divided by its arm, its
// inertia by the square of that, which changes as it turns.
template <class P>
template <class S>
void PlantOf<P>::lever_balance(const Stand<S>& stand, const S& v, const S& outer_N, Moment<S>& now, S& others,
                               S& mass_kg) const {
  using std::sin;
  const S& arm_m = stand.arm_m;
  const S lever_kg = inertia_kg_m2_ / (arm_m * arm_m);
  now.guide_force_N = -lever_->damping_N_m_s_per_rad * v / (arm_m * arm_m);
  if (springs_) now.spring_force_N = -lever_->spring().pull(stand.angle_rad) / arm_m;
  others = others + now.guide_force_N + now.spring_force_N - outer_N * (radius_m_ / arm_m) -
           weight_moment_N_m_ * sin(stand.angle_rad - lever_->hangs_at_rad) / arm_m +
           lever_kg * stand.arm_slope_m * v * v / (arm_m * arm_m);
  mass_kg = mass_kg + lever_kg;
}

template <class P>
template <class S>
S PlantOf<P>::joint_stop_force_N(const S& rise_m, const S& speed_m_per_s) const {
  const JointOf<P>& joint = rig().joint;
  return contact_N(S(lowest_m_ - rise_m), S(-speed_m_per_s), joint.stop_N_per_m, joint.stop_damping_s_per_m) -
         contact_N(S(rise_m - highest_m_), speed_m_per_s, joint.stop_N_per_m, joint.stop_damping_s_per_m);
}

// Hanging load, lever, or the link that two muscles turn.
template <class P>
template <int sides, class S, class H>
void PlantOf<P>::joint_balance(const State<S>& state, const HeldOf<H>& held, Moment<S>& now) const {
  using std::sin;
  const bool turns = sides == 1 && lever_.has_value();
  const S v = side_.braid().rest_length_m() * state.joint.contraction_speed_per_s;
  now.guide_force_N = -damping_N_s_per_m_ * v;
  S others = now.braid_force_N + now.stop_force_N + now.guide_force_N - hanging_N_ + now.effects_pull_N;
  if (side_.stretches())
    others = side_.where_it_stretches(
        S(now.stretched_N + now.pull_on_load_N + now.guide_force_N - hanging_N_), others);
  S mass_kg = S(mass_kg_), outer_N = S(held.joint_force_N);
  if (!turns) others = others - held.joint_force_N;
  now.spring_force_N = now.joint_stop_force_N = S(0.0);
  if (turns) {
    const Stand<S> stand = turning_->at(rise_m(state.joint.contraction_ratio));
    lever_balance(stand, v, outer_N, now, others, mass_kg);
    outer_N = outer_N * (radius_m_ / stand.arm_m);
  } else if (springs_) {
    now.spring_force_N = spring_force_N(state.joint.contraction_ratio);
    others = others + now.spring_force_N;
  }
  if constexpr (sides == 2) {
    const S lean = (state.joint.contraction_ratio - link_.contraction_ratio) *
                       (side_.braid().rest_length_m() / radius_m_) -
                   link_.hangs_at_rad;
    const SideMoment<S>& other = now.opposite;
    const S rigid_N = others - other.braid_force_N - other.stop_force_N - other.effects_pull_N;
    others = opposite_->stretches() ? opposite_->where_it_stretches(
                                          S(others - other.stretched_N - other.pull_on_load_N), rigid_N)
                                    : rigid_N;
    others = others - link_.mass_kg * gravity_m_per_s2 * link_.length_m / radius_m_ * sin(lean);
  }
  if (stops_) {
    now.joint_stop_force_N = joint_stop_force_N(rise_m(state.joint.contraction_ratio), v);
    others = others + now.joint_stop_force_N;
  }
  if (has_events()) {  // the joint sticks or slips as a whole, the opposite threads the other way
    const S level = friction_level_N<sides>(now);
    S whole = held.slip == Slip::rising ? S(-level) : level;
    if (held.slip == Slip::sticking) whole = held.length_is_given ? S(0.0) : S(-others);
    now.friction_force_N = whole;
    if constexpr (sides == 2) {
      now.friction_force_N = whole * (now.friction_level_N / level);
      now.opposite.friction_force_N = now.friction_force_N - whole;
    }
  }
  const S all = others + friction_force_N<sides>(now);
  now.bench_force_N = (held.length_is_given ? S(-all) : S(0.0)) - outer_N;
  now.acceleration_m_per_s2 = held.length_is_given ? S(0.0) : turns ? S(all / mass_kg) : S(all / mass_kg_);
}

}  // namespace mckibben::plant
