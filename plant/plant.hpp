// The nominal plant on one page: servo valve, hose, gas, Tondu-Lopez braid, thread friction, braid stop,
// load. T = thesis, TL = Tondu & Lopez, IEEE Control Systems Magazine 20 (2000) 15-38. docs/equations.md has
// them all.
//
//   State, Memory, Held --(moment)--> Moment: all that is known at this instant --(rates)--> dx/dt
//
// Effects that the rig has switched on come in where `effects_` stands; without any, no line of theirs runs.
// S is double, or a dual number where the Jacobian is wanted.
#pragma once

#include <plant/flow.hpp>
#include <plant/friction.hpp>
#include <plant/geometry.hpp>
#include <plant/state.hpp>

namespace mckibben::plant {

/// Everything known at one instant. Forces in N and positive where they lift the load, flows in kg/s.
template <class S>
struct Moment {
  S speed_m_per_s;                               // v = l0 w
  S valve_opening;                               // u, -1 (venting) to 1 (filling)
  S supply_flow, vent_flow, hose_flow;           // q_v = supply_flow - vent_flow, q_h
  S volume_m3, volume_slope_m3;                  // V, dV/de
  S braid_force_N, stop_force_N, guide_force_N;  // F, F_s, c v
  S friction_level_N, friction_force_N;          // G, F_f
  S bristle_rate_m_per_s;                        // dz/dt
  S acceleration_m_per_s2;                       // dv/dt
  S leak_flow, effects_pull_N;                   // what effects take and add
  Memory<S> memory_rates;                        // of effects
};

class Plant {
 public:
  /// The rig with a load [kg] hung on it. The rig's values are taken as checked.
  Plant(const Rig& rig, double load_kg);

  /// Gauge pressure [Pa] the valve is asked for at a current [mA] (T 3.2), clamped to its trimmed range.
  double reference_pressure_Pa(double current_mA) const;

  /// State at the start of a run: at rest, both pressures at the reference of the first current.
  State<double> at_rest(const Held& held) const;

  /// The balances of the rig. Only for states inside `in_domain`.
  template <class S>
  Moment<S> moment(const State<S>& state, const Memory<S>& memory, const Held& held) const;
  /// The same with effects as they are at rest.
  template <class S>
  Moment<S> moment(const State<S>& state, const Held& held) const {
    Memory<S> none;
    none.fill(S(0.0));
    return moment(state, none, held);
  }

  template <class S>
  State<S> rates(const State<S>& state, const Moment<S>& now) const;

  template <class S>
  Ledger<S> ledger_rates(const State<S>& state, const Moment<S>& now, const Ledger<double>& books) const;
  /// A ledger as it is opened: nothing has come or gone, and all gas has the walls' temperature.
  Ledger<double> opened(const State<double>& state) const;

  /// Whether every law is defined here: finite, braid neither folded nor torn, pressures above vacuum.
  bool in_domain(const State<double>& state) const {
    const double atmosphere = rig_.gas.atmosphere_Pa;
    // A sum that is finite has only finite terms; comparisons with NaN are false.
    return braid_.in_domain(state.joint.contraction_ratio) && state.side.valve_pressure_Pa > -atmosphere &&
           state.side.muscle_pressure_Pa > -atmosphere &&
           std::isfinite(state.side.valve_pressure_Pa + state.side.muscle_pressure_Pa + state.side.bristle_m +
                         state.joint.contraction_speed_per_s);
  }

  /// Whether an effect with a memory is switched on.
  bool remembers() const { return remembers_; }

  /// Whether the gas has a temperature of its own, which its ledger follows.
  bool polytropic() const { return polytropic_; }

  /// Exact stick and slip: falls through zero when the slip mode must change. Only with Coulomb friction.
  bool has_events() const { return rig_.friction.memory == FrictionMemory::coulomb; }
  double event_margin(const State<double>& state, const Memory<double>& memory, const Held& held) const;
  /// Mode after such an event (or at the start). Sets the speed to exactly zero.
  Slip slip_from_rest(State<double>& state, const Memory<double>& memory, const Held& held) const;

  const Rig& rig() const { return rig_; }
  /// Weight [N] of what hangs on the wheel.
  double weight_N() const { return weight_N_; }
  /// Mass of gas [kg] in valve and muscle, at the walls' temperature.
  double gas_mass_kg(const State<double>& state) const;
  /// Kinetic and potential energy of the load [J], zero at rest at e = 0.
  double mechanical_energy_J(const State<double>& state) const;
  /// What the ledger cannot account for of the way from one state to another.
  Imbalance imbalance(const State<double>& from, const State<double>& to, const Ledger<double>& books) const;

 private:
  template <class S>
  Instant<S> instant(const State<S>& state, const Moment<S>& now) const;
  template <class S>
  void gas_books(const State<S>& state, const Moment<S>& now, const Ledger<double>& books,
                 Ledger<S>& rates) const;
  template <class S>
  void gas_balance(const State<S>& state, const Memory<S>& memory, const Held& held, Moment<S>& now) const;
  template <class S>
  void force_balance(const State<S>& state, const Memory<S>& memory, const Held& held, Moment<S>& now) const;

  Rig rig_;
  Braid braid_;
  Restriction valve_, hose_, unit_flow_;
  bool effects_, remembers_, polytropic_;  // any switched on; any with a memory; the gas is not isothermal
  double mass_kg_, weight_N_, gas_energy_J_per_kg_, supply_Pa_;
};

template <class S>
Moment<S> Plant::moment(const State<S>& state, const Memory<S>& memory, const Held& held) const {
  Moment<S> now;
  now.speed_m_per_s = braid_.rest_length_m() * state.joint.contraction_speed_per_s;
  gas_balance(state, memory, held, now);
  force_balance(state, memory, held, now);
  return now;
}

template <class S>
Instant<S> Plant::instant(const State<S>& state, const Moment<S>& now) const {
  const S& e = state.joint.contraction_ratio;
  return {e,         braid_.rest_length_m() * e, now.speed_m_per_s,    state.side.muscle_pressure_Pa,
          weight_N_, rig_.gas.atmosphere_Pa,     gas_energy_J_per_kg_, unit_flow_};
}

// Pressure error opens one of two proportional valves (T 3.1); ISO 6358 flow through valve and hose.
template <class S>
void Plant::gas_balance(const State<S>& state, const Memory<S>& memory, const Held& held,
                        Moment<S>& now) const {
  const double atmosphere = rig_.gas.atmosphere_Pa;
  const S valve_Pa = state.side.valve_pressure_Pa + atmosphere;  // absolute from here
  const S muscle_Pa = state.side.muscle_pressure_Pa + atmosphere;

  S error_Pa = held.reference_pressure_Pa - state.side.valve_pressure_Pa;
  S supply_Pa = S(supply_Pa_);
  if (effects_) {
    error_Pa = error_Pa + rig_.effects.valve_error_shift_Pa(error_Pa);
    supply_Pa = supply_Pa - rig_.effects.supply_drop_Pa(memory);
  }
  S u = error_Pa / rig_.valve.proportional_band_Pa;
  if (u > 1.0) u = S(1.0);
  if (u < -1.0) u = S(-1.0);
  const S wanted = u;
  if (effects_) u = rig_.effects.valve_opening(wanted, memory);
  now.valve_opening = u;
  now.supply_flow = now.vent_flow = S(0.0);
  if (u >= 0.0)
    now.supply_flow = u * valve_.flow_kg_per_s(supply_Pa, valve_Pa);
  else
    now.vent_flow = -u * valve_.flow_kg_per_s(valve_Pa, S(atmosphere));
  now.hose_flow = hose_.flow_kg_per_s(valve_Pa, muscle_Pa);

  now.volume_m3 = braid_.volume_m3(state.joint.contraction_ratio);
  now.volume_slope_m3 = braid_.volume_slope_m3(state.joint.contraction_ratio);

  now.leak_flow = S(0.0);
  if (effects_) {
    const auto known = instant(state, now);
    now.leak_flow = rig_.effects.outflow_kg_per_s(known);
    now.memory_rates = rig_.effects.memory_rates(known, Inflow<S>{wanted, now.supply_flow}, memory);
  }
}

// Braid force (T 2.8), thread friction (T 2.11, 4.2, 4.6 and LuGre), braid stop (Hunt-Crossley), hanging
// load.
template <class S>
void Plant::force_balance(const State<S>& state, const Memory<S>& memory, const Held& held,
                          Moment<S>& now) const {
  using std::abs;
  const Friction& friction = rig_.friction;
  const S& e = state.joint.contraction_ratio;
  const S& z = state.side.bristle_m;
  const S& v = now.speed_m_per_s;

  now.braid_force_N = braid_.force_N(e, state.side.muscle_pressure_Pa);
  now.guide_force_N = -rig_.joint.guide_damping_N_s_per_m * v;
  now.stop_force_N = S(0.0);
  if (e < 0.0) {
    const S damping = 1.0 - rig_.muscle.stop_damping_s_per_m * v;
    if (damping > 0.0)
      now.stop_force_N = -rig_.muscle.stop_stiffness_N_per_m * braid_.rest_length_m() * e * damping;
  }
  const S surface = braid_.contact_surface_m2(e);
  now.friction_level_N =
      friction_level_N(friction, e, surface, state.side.muscle_pressure_Pa, held.current_speed_mA_per_s);
  now.effects_pull_N = S(0.0);
  if (effects_) {
    const auto known = instant(state, now);
    const S& pressure_Pa = state.side.muscle_pressure_Pa;
    now.braid_force_N = braid_.force_N(e, pressure_Pa, rig_.effects.end_correction_shift(known));
    now.effects_pull_N = rig_.effects.pull_N(known, memory);
    const S threads_N = now.friction_level_N - friction.floor_N;  // the floor is not friction of threads
    now.friction_level_N = threads_N * rig_.effects.friction_factor(known, memory) + friction.floor_N;
  }
  const S others = now.braid_force_N + now.stop_force_N + now.guide_force_N - weight_N_ + now.effects_pull_N;

  now.bristle_rate_m_per_s = S(0.0);
  if (friction.memory == FrictionMemory::lugre) {
    const double sigma0 = friction.bristle_stiffness_N_per_m;
    now.bristle_rate_m_per_s = v - sigma0 * abs(v) * z / now.friction_level_N;
    now.friction_force_N = -(sigma0 * z + friction.bristle_damping_N_s_per_m * now.bristle_rate_m_per_s);
  } else if (held.slip == Slip::sticking) {
    now.friction_force_N = -others;
  } else {
    now.friction_force_N = held.slip == Slip::rising ? S(-now.friction_level_N) : now.friction_level_N;
  }
  now.acceleration_m_per_s2 = (others + now.friction_force_N) / mass_kg_;
}

template <class S>
State<S> Plant::rates(const State<S>& state, const Moment<S>& now) const {
  const S& w = state.joint.contraction_speed_per_s;
  const S muscle_Pa = state.side.muscle_pressure_Pa + rig_.gas.atmosphere_Pa;
  const double RT = gas_energy_J_per_kg_;
  State<S> dt;
  dt.joint.contraction_ratio = w;
  dt.joint.contraction_speed_per_s = now.acceleration_m_per_s2 / braid_.rest_length_m();
  dt.side.valve_pressure_Pa = RT / rig_.valve.volume_m3 * (now.supply_flow - now.vent_flow - now.hose_flow);
  dt.side.muscle_pressure_Pa = (RT * now.hose_flow - muscle_Pa * now.volume_slope_m3 * w) / now.volume_m3;
  dt.side.bristle_m = now.bristle_rate_m_per_s;
  if (effects_) {
    const double n = rig_.effects.gas_exponent();
    dt.side.valve_pressure_Pa = n * dt.side.valve_pressure_Pa;
    dt.side.muscle_pressure_Pa = n * (dt.side.muscle_pressure_Pa - RT * now.leak_flow / now.volume_m3);
  }
  return dt;
}

template <class S>
Ledger<S> Plant::ledger_rates(const State<S>& state, const Moment<S>& now,
                              const Ledger<double>& books) const {
  const S& v = now.speed_m_per_s;
  const S none = S(0.0);
  Ledger<S> rates{now.supply_flow,
                  now.vent_flow,
                  now.leak_flow,
                  S(now.braid_force_N * v),
                  S(-now.friction_force_N * v),
                  S(-now.guide_force_N * v),
                  S(now.stop_force_N * v),
                  S(now.effects_pull_N * v),
                  none,
                  none,
                  none,
                  none};
  if (polytropic_) gas_books(state, now, books, rates);
  return rates;
}

// The pressure rates count each flow q as the enthalpy of q at the walls' temperature T. Gas of another
// temperature carries it with another mass: q T/T_gas of the volume it leaves, where p V = m R T_gas.
template <class S>
void Plant::gas_books(const State<S>& state, const Moment<S>& now, const Ledger<double>& books,
                      Ledger<S>& rates) const {
  const double atmosphere = rig_.gas.atmosphere_Pa, RT = gas_energy_J_per_kg_;
  const S muscle_Pa = state.side.muscle_pressure_Pa + atmosphere;
  const S in_valve = books.valve_air_kg * RT /
                     ((state.side.valve_pressure_Pa + atmosphere) * rig_.valve.volume_m3);  // T/T_gas
  const S in_muscle = books.muscle_air_kg * RT / (muscle_Pa * now.volume_m3);
  const auto carried = [](const S& flow, const S& from, const S& back) {
    return S(flow * (flow < 0.0 ? back : from));
  };
  const S outside = S(1.0);
  rates.air_drawn_kg = carried(now.supply_flow, outside, in_valve);
  rates.air_vented_kg = carried(now.vent_flow, in_valve, outside);
  rates.air_leaked_kg = carried(now.leak_flow, in_muscle, outside);
  const S through_hose = carried(now.hose_flow, in_valve, in_muscle);
  rates.valve_air_kg = rates.air_drawn_kg - rates.air_vented_kg - through_hose;
  rates.muscle_air_kg = through_hose - rates.air_leaked_kg;
  rates.air_inflow_J = RT * (now.supply_flow - now.vent_flow - now.leak_flow);
  rates.gas_work_J = muscle_Pa * now.volume_slope_m3 * state.joint.contraction_speed_per_s;
}

}  // namespace mckibben::plant
