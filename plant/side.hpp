// One side of a joint: valve, hose, gas, Tondu-Lopez braid, thread friction, braid stop. T = thesis,
// TL = Tondu & Lopez, IEEE Control Systems Magazine 20 (2000) 15-38. docs/equations.md has them all.
//
//   where the cord's end is and how fast, SideState, memory, HeldSide --> SideMoment --> d(SideState)/dt
//
// Effects that the rig has switched on come in where `effects_` stands; without any, no line of theirs runs.
// S is double, a dual number where the Jacobian is wanted, or lanes that hold several rigs; P is what their
// parameters are made of; H what is held: P, or S where slopes by it are wanted.
#pragma once

#include <algorithm>
#include <concepts>
#include <numbers>
#include <utility>

#include <plant/friction.hpp>
#include <plant/geometry.hpp>
#include <plant/restriction.hpp>
#include <plant/state.hpp>

namespace mckibben::plant {

/// The cord's end of one muscle, as the joint moves it.
template <class S>
struct Stroke {
  S contraction_ratio;  ///< e
  S speed_per_s;        ///< w = de/dt
};

/// Everything known of a side at one instant.
/// Forces in N and positive where they shorten the muscle, flows in kg/s.
template <class S>
struct SideMoment {
  Stroke<S> stroke;                      // the muscle's own
  S speed_m_per_s;                       // v = l0 w
  S pressure_error_Pa;                   // what the valve acts on: P_ref - P_v, less its dead band
  S wanted_opening, valve_opening;       // u, -1 (venting) to 1 (filling): before and after effects
  S supply_flow, vent_flow, hose_flow;   // q_v = supply_flow - vent_flow, q_h
  S volume_m3, volume_slope_m3;          // V, dV/de
  S braid_force_N, stop_force_N;         // F, F_s
  S friction_level_N, friction_force_N;  // G, F_f
  S bristle_rate_m_per_s;                // dz/dt
  S leak_flow, effects_pull_N;           // what effects take and add
  S pull_on_load_N;                      // of that, beyond the cord
  S heating_Pa_per_s;                    // what the temperature of the muscle's gas adds to dP_m/dt
  SideMemory<S> memory_rates;
  bool stretches;              // its cord; if so:
  S stretched_N, cord_lost_W;  // what that pulls with, and what its damping takes

  /// T, what the cord carries.
  S cord_force_N() const {
    if (stretches) return stretched_N;
    return muscle_force_N();
  }
  /// What the muscle pulls on it with.
  S muscle_force_N() const {
    return braid_force_N + stop_force_N + effects_pull_N + friction_force_N - pull_on_load_N;
  }
};

template <class P>
class SideOf {
 public:
  /// `weight_N`: of what hangs on the cord; 0 in a pair.
  SideOf(const RigOf<P>& rig, const P& weight_N);

  /// Pressure error opens one of two proportional valves (T 3.1), in proportion to it, or so far that the
  /// pressure follows with a regulator's lag; ISO 6358 flow through valve and hose.
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
  /// How far a command is on the way from zero_command to span_command, 0 to 1.
  double way(double current_mA) const;
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
  bool may_remember() const { return effects_ || swings_ || stretches_; }
  /// What laws add to the rise that is read [m].
  double reading_shift_m(const Stroke<double>& stroke, const SideState<double>& state,
                         const SideMemory<double>& memory, const HeldSide& held) const;
  /// A law that is no number here, as if nothing were remembered; empty if all are.
  std::string_view law_without_number(const Stroke<double>& stroke, const SideState<double>& state) const;
  /// R T [J/kg].
  const P& gas_energy_J_per_kg() const { return gas_energy_J_per_kg_; }

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
            gas_energy_J_per_kg_,
            unit_flow_,
            state.valve_pressure_Pa,
            held.reference_pressure_Pa,
            braid_.force_N(e, state.muscle_pressure_Pa) * share_};
  }
  template <class S>
  S muscle_pressure_rate_Pa_per_s(const Stroke<S>& stroke, const SideState<S>& state,
                                  const SideMoment<S>& now) const;
  template <class S>
  S flow_to_follow(const SideMemory<S>& memory, const S& error_Pa, const S& hose_flow) const;
  template <class S, class H>
  void valve_flows(const Stroke<S>& stroke, const SideState<S>& state, const SideMemory<S>& memory,
                   const HeldSideOf<H>& held, SideMoment<S>& now) const;
  template <class S, class H>
  void switched_flows(const SideState<S>& state, const SideMemory<S>& memory, const HeldSideOf<H>& held,
                      SideMoment<S>& now) const;
  template <class S, class H>
  void given_flows(const Stroke<S>& stroke, const SideState<S>& state, const HeldSideOf<H>& held,
                   SideMoment<S>& now) const;
  template <class S>
  static Inflow<S> inflow(const Stroke<S>& stroke, const SideMoment<S>& now, const S& supply_flow) {
    return {now.wanted_opening, supply_flow,   now.hose_flow,
            now.leak_flow,      now.volume_m3, S(now.volume_slope_m3 * stroke.speed_per_s)};
  }

  /// A valve between equal pressures can pass nothing: what is wanted is not divided by less.
  static constexpr double least_flow_kg_per_s = 1e-9;

  RigOf<P> rig_;
  BraidOf<P> braid_;
  RestrictionOf<P> valve_, vent_, hose_, unit_flow_;
  bool effects_, regulates_, swings_, switches_, sealed_, stretches_;
  decltype(std::declval<P>() == 0.0) on_cord_;  // a cord that stretches; of lanes, which
  double count_, share_;                        // muscles side by side; 1/count
  FrictionOf<P> friction_;                      // of all of them, by the contact surface of one
  P leak_kg_per_s_Pa_;                          // of valves that are shut
  P weight_N_, gas_energy_J_per_kg_, valve_stiffness_Pa_per_kg_, supply_Pa_, exhaust_Pa_;
  P quickness_per_s_, catching_up_per_s_;  // of a regulator: dP_v/dt for an error, the memory's for its own
};
using Side = SideOf<double>;

template <class P>
SideOf<P>::SideOf(const RigOf<P>& rig, const P& weight_N)
    : rig_(rig),
      braid_(rig.muscle),
      valve_(restriction(rig, rig.valve.conductance_m3_per_s_Pa)),
      vent_(restriction(rig, venting_conductance(rig))),
      hose_(restriction(rig, P(static_cast<double>(rig.muscle.count) * rig.hose.conductance_m3_per_s_Pa))),
      unit_flow_(restriction(rig, P(1.0))),
      effects_(!rig.effects.absent()),
      regulates_(rig.valve.is_regulator()),
      swings_(rig.valve.swings()),
      switches_(rig.valve.is_on_off()),
      sealed_(rig.valve.seals()),
      stretches_(any(!rig.muscle.cord.absent())),
      on_cord_(!rig.muscle.cord.absent()),
      count_(rig.muscle.count),
      share_(1.0 / count_),
      friction_(side_by_side(rig.friction, count_)),
      leak_kg_per_s_Pa_(restriction(rig, rig.valve.leak_m3_per_s_Pa).conductance_kg_per_s_Pa),
      weight_N_(weight_N),
      gas_energy_J_per_kg_(rig.gas.gas_constant_J_per_kg_K * rig.gas.temperature_K),
      valve_stiffness_Pa_per_kg_(gas_energy_J_per_kg_ / rig.valve.volume_m3),
      supply_Pa_(rig.valve.supply_pressure_Pa + rig.gas.atmosphere_Pa),
      exhaust_Pa_(rig.valve.exhaust_pressure_Pa + rig.gas.atmosphere_Pa),
      quickness_per_s_(1.0),
      catching_up_per_s_(1.0) {
  if constexpr (std::same_as<P, double>) rig_.effects.laws.take_places();  // those of lanes have theirs
  const P& venting = rig.valve.venting_critical_ratio;
  if (switches_) vent_.critical_ratio = select(venting > 0.0, venting, rig.valve.critical_ratio);
  const P swing_per_s = 2.0 * std::numbers::pi * rig.valve.natural_frequency_Hz;
  if (swings_) catching_up_per_s_ = 2.0 * rig.valve.damping * swing_per_s;
  if (regulates_)
    quickness_per_s_ =
        swings_ ? P(swing_per_s * swing_per_s / catching_up_per_s_) : P(1.0 / rig.valve.time_constant_s);
}

// Air for the volume, whose pressure is to change by the error over the lag's time, and for the hose.
template <class P>
template <class S>
S SideOf<P>::flow_to_follow(const SideMemory<S>& memory, const S& error_Pa, const S& hose_flow) const {
  const P n = effects_ ? rig_.effects.gas_exponent() : P(1.0);
  const S followed_Pa = swings_ ? memory[regulator_memory] : error_Pa;
  return followed_Pa * (quickness_per_s_ * rig_.valve.volume_m3 / (n * gas_energy_J_per_kg_)) + hose_flow;
}

template <class P>
template <class S, class H>
void SideOf<P>::valve_flows(const Stroke<S>& stroke, const SideState<S>& state, const SideMemory<S>& memory,
                            const HeldSideOf<H>& held, SideMoment<S>& now) const {
  const P& atmosphere = rig_.gas.atmosphere_Pa;
  const S valve_Pa = state.valve_pressure_Pa + atmosphere;  // absolute from here
  const S muscle_Pa = state.muscle_pressure_Pa + atmosphere;

  S error_Pa = held.reference_pressure_Pa - state.valve_pressure_Pa;
  S supply_Pa = S(supply_Pa_ + held.supply_above_Pa);
  if (effects_ && !rig_.effects.laws.list.empty())
    error_Pa = error_Pa + rig_.effects.command_shift_Pa(instant(stroke, state, held, now), memory);
  if (regulates_)
    error_Pa = error_Pa + ValveDeadBandOf<P>{rig_.valve.dead_band_Pa}.valve_error_shift_Pa(error_Pa);
  if (effects_) {
    error_Pa = error_Pa + rig_.effects.valve_error_shift_Pa(error_Pa);
    supply_Pa = supply_Pa - rig_.effects.supply_drop_Pa(memory);
  }
  now.pressure_error_Pa = error_Pa;
  now.hose_flow = hose_.flow_kg_per_s(valve_Pa, muscle_Pa);
  // What the valve passes where it is wide open to the supply, or to the atmosphere.
  const auto wide_open = [&](const auto& fills) {
    return RestrictionOf<P>{select(fills, valve_.conductance_kg_per_s_Pa, vent_.conductance_kg_per_s_Pa),
                            valve_.critical_ratio, valve_.linear_zone_Pa}
        .flow_kg_per_s(S(select(fills, supply_Pa, valve_Pa)), S(select(fills, valve_Pa, S(exhaust_Pa_))));
  };
  S u;
  if (regulates_) {
    const S flow = flow_to_follow(memory, error_Pa, now.hose_flow);
    const S most = wide_open(flow >= 0.0);
    u = flow / select(most > least_flow_kg_per_s, most, S(least_flow_kg_per_s));
  } else {
    u = error_Pa / rig_.valve.proportional_band_Pa;
  }
  u = select(u > 1.0, S(1.0), u);
  u = select(u < -1.0, S(-1.0), u);
  now.wanted_opening = u;
  if (effects_) u = rig_.effects.valve_opening(now.wanted_opening, memory);
  now.valve_opening = u;
  const auto fills = u >= 0.0;
  const S flow = u * wide_open(fills);
  now.supply_flow = select(fills, flow, S(0.0));
  now.vent_flow = select(fills, S(0.0), S(-flow));
}

// One valve to the supply, one to the atmosphere, each open or shut; both may be either at once.
template <class P>
template <class S, class H>
void SideOf<P>::switched_flows(const SideState<S>& state, const SideMemory<S>& memory,
                               const HeldSideOf<H>& held, SideMoment<S>& now) const {
  const P& atmosphere = rig_.gas.atmosphere_Pa;
  const S valve_Pa = state.valve_pressure_Pa + atmosphere;
  S supply_Pa = S(supply_Pa_ + held.supply_above_Pa);
  if (effects_) supply_Pa = supply_Pa - rig_.effects.supply_drop_Pa(memory);
  const auto through = [this](const RestrictionOf<P>& open, const H& share, const S& from, const S& to) {
    RestrictionOf<P> leak = open;
    leak.conductance_kg_per_s_Pa = leak_kg_per_s_Pa_;
    return S(share * open.flow_kg_per_s(from, to) + (1.0 - share) * leak.flow_kg_per_s(from, to));
  };
  now.pressure_error_Pa = S(0.0);
  now.wanted_opening = now.valve_opening = S(held.fills - held.vents);
  now.hose_flow = hose_.flow_kg_per_s(valve_Pa, S(state.muscle_pressure_Pa + atmosphere));
  now.supply_flow = through(valve_, held.fills, supply_Pa, valve_Pa);
  now.vent_flow = through(vent_, held.vents, valve_Pa, S(exhaust_Pa_));
}

// Whatever keeps a given pressure brings the gas that this takes; so is a sealed muscle filled, until it is
// shut.
template <class P>
template <class S, class H>
void SideOf<P>::given_flows(const Stroke<S>& stroke, const SideState<S>& state, const HeldSideOf<H>& held,
                            SideMoment<S>& now) const {
  const P& atmosphere = rig_.gas.atmosphere_Pa;
  const S muscle_Pa = state.muscle_pressure_Pa + atmosphere;
  const P n = effects_ ? rig_.effects.gas_exponent() : P(1.0);
  now.pressure_error_Pa = now.wanted_opening = now.valve_opening = now.vent_flow = S(0.0);
  if (held.given == GivenPressure::muscle || sealed_) {
    now.hose_flow = (now.volume_m3 * (held.pressure_rate_Pa_per_s / n) +
                     muscle_Pa * now.volume_slope_m3 * stroke.speed_per_s) /
                        gas_energy_J_per_kg_ +
                    now.leak_flow;
    if (sealed_) now.hose_flow = held.fills * now.hose_flow;
    now.supply_flow = now.hose_flow;
  } else {
    now.hose_flow = hose_.flow_kg_per_s(S(state.valve_pressure_Pa + atmosphere), muscle_Pa);
    now.supply_flow =
        now.hose_flow + rig_.valve.volume_m3 * (held.pressure_rate_Pa_per_s / n) / gas_energy_J_per_kg_;
  }
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

  if (held.given != GivenPressure::none || sealed_)
    given_flows(stroke, state, held, now);
  else if (switches_)
    switched_flows(state, memory, held, now);
  else
    valve_flows(stroke, state, memory, held, now);
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
  if (swings_)
    now.memory_rates[regulator_memory] =
        catching_up_per_s_ * (now.pressure_error_Pa - memory[regulator_memory]);
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
  dt.valve_pressure_Pa = valve_stiffness_Pa_per_kg_ * (now.supply_flow - now.vent_flow - now.hose_flow);
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
  const P& RT = gas_energy_J_per_kg_;
  const S rate = (RT * now.hose_flow - muscle_Pa * now.volume_slope_m3 * stroke.speed_per_s) / now.volume_m3;
  if (!effects_) return rate;
  return rig_.effects.gas_exponent() * (rate - RT * now.leak_flow / now.volume_m3) + now.heating_Pa_per_s;
}

}  // namespace mckibben::plant
