// One side of a joint: valve and hose, gas, Tondu-Lopez braid, thread friction, braid stop. T = thesis,
// TL = Tondu & Lopez, IEEE Control Systems Magazine 20 (2000) 15-38. docs/equations.md has them all.
//
//   where the cord's end is and how fast, SideState, memory, HeldSide --> SideMoment --> d(SideState)/dt
//
// Effects that the rig has switched on come in where `effects_` stands; without any, no line of theirs runs.
// S is double, a dual number where the Jacobian is wanted, or lanes that hold several rigs; P is what their
// parameters are made of; H what is held: P, or S where slopes by it are wanted.
#pragma once

#include <concepts>
#include <utility>

#include <plant/friction.hpp>
#include <plant/geometry.hpp>
#include <plant/side_moment.hpp>
#include <plant/state.hpp>
#include <plant/valve_flow.hpp>

namespace mckibben::plant {

template <class P>
class SideOf {
 public:
  /// `weight_N`: of what hangs on the cord; 0 in a pair.
  SideOf(const RigOf<P>& rig, const P& weight_N);

  /// What comes through valve and hose, or what keeps a given pressure; leaks and heat.
  template <class S, class H>
  void gas_balance(const Stroke<S>& stroke, const SideState<S>& state, const SideMemory<S>& memory,
                   const HeldSideOf<H>& held, SideMoment<S>& now) const;
  /// Braid force (T 2.8), braid stop (Hunt-Crossley), friction level (T 2.11, 4.2, 4.6) and what LuGre's
  /// bristle makes of it. After the gas.
  template <class S, class H>
  void forces(const Stroke<S>& stroke, const SideState<S>& state, const SideMemory<S>& memory,
              const HeldSideOf<H>& held, SideMoment<S>& now) const;
  /// What effects and a regulator remember, where `supply_flow` [kg/s] is drawn from the supply by all sides.
  /// After the gas.
  template <class S, class H>
  void remember(const Stroke<S>& stroke, const SideState<S>& state, const SideMemory<S>& memory,
                const HeldSideOf<H>& held, const S& supply_flow, SideMoment<S>& now) const;
  template <class S>
  SideState<S> rates(const SideState<S>& state, const SideMoment<S>& now) const;

  /// Whether the cord between muscle and joint stretches; of lanes, that of any.
  bool stretches() const { return stretches_; }
  /// The muscle's own stroke, where the joint moves its cord's end so.
  template <class S>
  Stroke<S> stroke(const Stroke<S>& joint, const SideMemory<S>& memory) const {
    if (!stretches_) return joint;
    const P& length_m = braid_.rest_length_m();
    return {joint.contraction_ratio + memory[cord_stretch] / length_m,
            select(on_cord_, S(memory[cord_end_speed] / length_m), joint.speed_per_s)};
  }
  /// What a cord that stretches carries, and how it goes on. After the forces; only where one does.
  template <class S, class H>
  void stretch(const Stroke<S>& joint, const SideState<S>& state, const SideMemory<S>& memory,
               const HeldSideOf<H>& held, SideMoment<S>& now) const;
  /// One of two values, of which the first is for a cord that stretches.
  template <class S>
  S where_it_stretches(const S& yes, const S& no) const {
    return select(on_cord_, yes, no);
  }
  /// Of thread friction what the joint feels: a cord that stretches has it in its own pull.
  template <class S>
  S felt_friction_N(const SideMoment<S>& now) const {
    if (!stretches_) return now.friction_force_N;
    return select(on_cord_, S(0.0), now.friction_force_N);
  }

  auto in_domain(const Stroke<P>& joint, const SideState<P>& state, const SideMemory<P>& memory) const {
    using std::isfinite;
    const P& atmosphere = rig_.gas.atmosphere_Pa;
    const Stroke<P> own = stroke(joint, memory);
    // A sum that is finite has only finite terms; comparisons with NaN are false.
    return braid_.in_domain(own.contraction_ratio) && state.valve_pressure_Pa > -atmosphere &&
           state.muscle_pressure_Pa > -atmosphere &&
           isfinite(state.valve_pressure_Pa + state.muscle_pressure_Pa + state.bristle_m);
  }

  double reference_pressure_Pa(double current_mA) const;
  /// How much more a mA asks for [Pa/mA]; nothing beyond the valve's trimmed range.
  double reference_slope_Pa_per_mA(double current_mA) const;
  /// Gas [kg] in valve and muscle, and in the valve alone, at the walls' temperature.
  double air_kg(const Stroke<double>& joint, const SideState<double>& state,
                const SideMemory<double>& memory) const;
  double valve_air_kg(const SideState<double>& state) const;

  const RigOf<P>& rig() const { return rig_; }
  const BraidOf<P>& braid() const { return braid_; }
  const P& weight_N() const { return weight_N_; }
  bool has_effects() const { return effects_; }
  /// Whether there is something to `remember`.
  bool may_remember() const { return effects_ || valve_flow_.swings() || stretches_; }
  /// What laws add to the rise that is read [m].
  double reading_shift_m(const Stroke<double>& stroke, const SideState<double>& state,
                         const SideMemory<double>& memory, const HeldSide& held) const;
  /// A law that is no number here, as if nothing were remembered; empty if all are.
  std::string_view law_without_number(const Stroke<double>& stroke, const SideState<double>& state) const;
  /// R T [J/kg].
  const P& gas_energy_J_per_kg() const { return valve_flow_.gas_energy_J_per_kg(); }

 private:
  template <class S, class H>
  Instant<S> instant(const Stroke<S>& stroke, const SideState<S>& state, const HeldSideOf<H>& held,
                     const SideMoment<S>& now) const {
    const S& e = stroke.contraction_ratio;
    return {e,
            braid_.rest_length_m() * e,
            now.speed_m_per_s,
            state.muscle_pressure_Pa,
            weight_N_,
            rig_.gas.atmosphere_Pa,
            gas_energy_J_per_kg(),
            unit_flow_,
            state.valve_pressure_Pa,
            held.reference_pressure_Pa,
            braid_.force_N(e, state.muscle_pressure_Pa) * share_};
  }
  template <class S>
  S muscle_pressure_rate_Pa_per_s(const Stroke<S>& stroke, const SideState<S>& state,
                                  const SideMoment<S>& now) const;
  template <class S, class H>
  ValveMoment<S> valve_moment(const Stroke<S>& stroke, const SideState<S>& state, const SideMemory<S>& memory,
                              const HeldSideOf<H>& held, const SideMoment<S>& now) const;
  template <class S>
  static Inflow<S> inflow(const Stroke<S>& stroke, const SideMoment<S>& now, const S& supply_flow) {
    return {now.wanted_opening, supply_flow,   now.hose_flow,
            now.leak_flow,      now.volume_m3, S(now.volume_slope_m3 * stroke.speed_per_s)};
  }

  RigOf<P> rig_;
  BraidOf<P> braid_;
  ValveFlowOf<P> valve_flow_;
  RestrictionOf<P> unit_flow_;
  bool effects_, sealed_, stretches_;
  decltype(std::declval<P>() == 0.0) on_cord_;  // a cord that stretches; of lanes, which
  double count_, share_;                        // muscles side by side; 1/count
  FrictionOf<P> friction_;                      // of all of them, by the contact surface of one
  P weight_N_;
};
using Side = SideOf<double>;

template <class P>
SideOf<P>::SideOf(const RigOf<P>& rig, const P& weight_N)
    : rig_(rig),
      braid_(rig.muscle),
      valve_flow_(rig),
      unit_flow_(restriction(rig, P(1.0))),
      effects_(!rig.effects.absent()),
      sealed_(rig.valve.seals()),
      stretches_(any(!rig.muscle.cord.absent())),
      on_cord_(!rig.muscle.cord.absent()),
      count_(rig.muscle.count),
      share_(1.0 / count_),
      friction_(side_by_side(rig.friction, count_)),
      weight_N_(weight_N) {
  if constexpr (std::same_as<P, double>) rig_.effects.laws.take_places();  // those of lanes have theirs
}

// Whatever keeps a given pressure brings the gas that this takes; so is a sealed muscle filled, until it is
// shut.
template <class P>
template <class S, class H>
ValveMoment<S> SideOf<P>::valve_moment(const Stroke<S>& stroke, const SideState<S>& state,
                                       const SideMemory<S>& memory, const HeldSideOf<H>& held,
                                       const SideMoment<S>& now) const {
  const P& atmosphere = rig_.gas.atmosphere_Pa;
  const HoseEnds<S> ends{state.valve_pressure_Pa + atmosphere, state.muscle_pressure_Pa + atmosphere};
  const EffectsOf<P>* const effects = effects_ ? &rig_.effects : nullptr;
  if (held.given == GivenPressure::muscle || sealed_) {
    const P n = effects_ ? rig_.effects.gas_exponent() : P(1.0);
    S flow = (now.volume_m3 * (held.pressure_rate_Pa_per_s / n) +
              ends.muscle_Pa * now.volume_slope_m3 * stroke.speed_per_s) /
                 gas_energy_J_per_kg() +
             now.leak_flow;
    if (sealed_) flow = held.fills * flow;
    return {S(0.0), S(0.0), S(0.0), flow, S(0.0), flow};
  }
  if (held.given == GivenPressure::valve) return valve_flow_.kept(ends, held, effects);
  if (valve_flow_.switches()) return valve_flow_.switched(ends, memory, held, effects);
  S error_Pa = held.reference_pressure_Pa - state.valve_pressure_Pa;
  if (effects_ && !rig_.effects.laws.list.empty())
    error_Pa = error_Pa + rig_.effects.command_shift_Pa(instant(stroke, state, held, now), memory);
  return valve_flow_.proportional(ends, error_Pa, memory, held, effects);
}

template <class P>
template <class S, class H>
void SideOf<P>::gas_balance(const Stroke<S>& stroke, const SideState<S>& state, const SideMemory<S>& memory,
                            const HeldSideOf<H>& held, SideMoment<S>& now) const {
  const S& e = stroke.contraction_ratio;
  now.stroke = stroke;
  now.stretches = stretches_;
  now.speed_m_per_s = braid_.rest_length_m() * stroke.speed_per_s;
  now.volume_m3 = braid_.volume_m3(e);
  now.volume_slope_m3 = braid_.volume_slope_m3(e);
  now.leak_flow = S(0.0);
  if (effects_)
    now.leak_flow = count_ * rig_.effects.outflow_kg_per_s(instant(stroke, state, held, now), memory);

  static_cast<ValveMoment<S>&>(now) = valve_moment(stroke, state, memory, held, now);
  now.heating_Pa_per_s = S(0.0);
  if (effects_ && held.given != GivenPressure::muscle)
    now.heating_Pa_per_s = rig_.effects.heating_Pa_per_s(instant(stroke, state, held, now),
                                                         inflow(stroke, now, now.supply_flow), memory);
  if (sealed_) now.heating_Pa_per_s = (1.0 - held.fills) * now.heating_Pa_per_s;
}

template <class P>
template <class S, class H>
void SideOf<P>::remember(const Stroke<S>& stroke, const SideState<S>& state, const SideMemory<S>& memory,
                         const HeldSideOf<H>& held, const S& supply_flow, SideMoment<S>& now) const {
  Inflow<S> all = inflow(stroke, now, supply_flow);
  all.pressure_rate_Pa_per_s = muscle_pressure_rate_Pa_per_s(stroke, state, now);
  now.memory_rates = rig_.effects.memory_rates(instant(stroke, state, held, now), all, memory);
  if (valve_flow_.swings())
    now.memory_rates[regulator_memory] = valve_flow_.memory_rate(now.pressure_error_Pa, memory);
}

template <class P>
template <class S, class H>
void SideOf<P>::forces(const Stroke<S>& stroke, const SideState<S>& state, const SideMemory<S>& memory,
                       const HeldSideOf<H>& held, SideMoment<S>& now) const {
  using std::abs;
  const FrictionOf<P>& friction = friction_;
  const S& e = stroke.contraction_ratio;
  const S& z = state.bristle_m;
  const S& v = now.speed_m_per_s;
  S pressure_Pa = state.muscle_pressure_Pa;
  if (effects_) pressure_Pa = pressure_Pa + rig_.effects.pressing_shift_Pa(instant(stroke, state, held, now));

  now.braid_force_N = braid_.force_N(e, pressure_Pa);
  now.stop_force_N = choose(
      e < 0.0,
      [&] {
        const S damping = 1.0 - rig_.muscle.stop_damping_s_per_m * v;
        const S force_N = -braid_.stop_stiffness_N_per_m() * braid_.rest_length_m() * e * damping;
        return select(damping > 0.0, force_N, S(0.0));
      },
      [] { return S(0.0); });
  const S surface = braid_.contact_surface_m2(e) * share_;
  now.friction_level_N = friction_level_N(friction, e, surface, pressure_Pa, held.current_speed_mA_per_s);
  now.effects_pull_N = now.pull_on_load_N = S(0.0);
  if (effects_) {
    const auto known = instant(stroke, state, held, now);
    now.braid_force_N = braid_.force_N(e, pressure_Pa, rig_.effects.end_correction_shift(known));
    const Pull<S> pull = rig_.effects.pull(known, memory);
    now.effects_pull_N =
        count_ == 1.0 ? pull.all_N : S(count_ * (pull.all_N - pull.on_load_N) + pull.on_load_N);
    now.pull_on_load_N = pull.on_load_N;
    const S threads_N = now.friction_level_N - friction.floor_N;  // the floor is not friction of threads
    now.friction_level_N = threads_N * rig_.effects.friction_factor(known, memory) + friction.floor_N;
  }
  now.bristle_rate_m_per_s = S(0.0);
  if (friction.memory == FrictionMemory::lugre) {
    const P& sigma0 = friction.bristle_stiffness_N_per_m;
    now.bristle_rate_m_per_s = v - sigma0 * abs(v) * z / now.friction_level_N;
    now.friction_force_N = -(sigma0 * z + friction.bristle_damping_N_s_per_m * now.bristle_rate_m_per_s);
  }
}

// What acts on the load itself, beyond the cord, goes by the joint's motion and not by the muscle's.
template <class P>
template <class S, class H>
void SideOf<P>::stretch(const Stroke<S>& joint, const SideState<S>& state, const SideMemory<S>& memory,
                        const HeldSideOf<H>& held, SideMoment<S>& now) const {
  const CordOf<P>& cord = rig_.muscle.cord;
  const S joint_m_per_s = braid_.rest_length_m() * joint.speed_per_s;
  if (effects_) {
    Instant<S> there = instant(joint, state, held, now);
    there.speed_m_per_s = joint_m_per_s;
    const S on_load_N = select(on_cord_, S(rig_.effects.pull(there, memory).on_load_N), now.pull_on_load_N);
    now.effects_pull_N =
        select(on_cord_, S(now.effects_pull_N - now.pull_on_load_N + on_load_N), now.effects_pull_N);
    now.pull_on_load_N = on_load_N;
  }
  const S &stretch_m = memory[cord_stretch], &end_m_per_s = memory[cord_end_speed];
  const S rate_m_per_s = end_m_per_s - joint_m_per_s;
  now.stretched_N = select(on_cord_, cord.pull_N(stretch_m, rate_m_per_s), now.muscle_force_N());
  now.cord_lost_W = select(on_cord_, S((now.stretched_N - cord.spring_N(stretch_m)) * rate_m_per_s), S(0.0));
  now.memory_rates[cord_stretch] = select(on_cord_, rate_m_per_s, S(0.0));
  now.memory_rates[cord_end_speed] =
      select(on_cord_, S((now.muscle_force_N() - now.stretched_N) / cord.end_mass_kg), S(0.0));
}

template <class P>
template <class S>
SideState<S> SideOf<P>::rates(const SideState<S>& state, const SideMoment<S>& now) const {
  SideState<S> dt;
  dt.valve_pressure_Pa = valve_flow_.pressure_rate_Pa_per_s(now);
  if (effects_) dt.valve_pressure_Pa = rig_.effects.gas_exponent() * dt.valve_pressure_Pa;
  dt.muscle_pressure_Pa = muscle_pressure_rate_Pa_per_s(now.stroke, state, now);
  dt.bristle_m = now.bristle_rate_m_per_s;
  return dt;
}

template <class P>
template <class S>
S SideOf<P>::muscle_pressure_rate_Pa_per_s(const Stroke<S>& stroke, const SideState<S>& state,
                                           const SideMoment<S>& now) const {
  const S muscle_Pa = state.muscle_pressure_Pa + rig_.gas.atmosphere_Pa;
  const P& RT = gas_energy_J_per_kg();
  const S rate = (RT * now.hose_flow - muscle_Pa * now.volume_slope_m3 * stroke.speed_per_s) / now.volume_m3;
  if (!effects_) return rate;
  return rig_.effects.gas_exponent() * (rate - RT * now.leak_flow / now.volume_m3) + now.heating_Pa_per_s;
}

}  // namespace mckibben::plant
