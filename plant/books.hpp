// Where air and work go: the rates of a ledger. Part of plant.hpp, which includes it.
#pragma once

#include <plant/plant.hpp>

namespace mckibben::plant {

template <class P>
template <int sides, class S>
Ledger<S> PlantOf<P>::ledger_rates(const State<S>& state, const Moment<S>& now,
                                   const Ledger<P>& books) const {
  const S& v = now.speed_m_per_s;
  const S joint_m_per_s = side_.braid().rest_length_m() * state.joint.contraction_speed_per_s;
  const S none = S(0.0);
  Ledger<S> rates{now.supply_flow,
                  now.vent_flow,
                  now.leak_flow,
                  S(now.braid_force_N * v),
                  S(-now.friction_force_N * v),
                  S(-now.guide_force_N * joint_m_per_s),
                  S(now.stop_force_N * v + now.joint_stop_force_N * joint_m_per_s),
                  S(now.effects_pull_N * v),
                  S(now.bench_force_N * joint_m_per_s),
                  none,
                  none,
                  none,
                  none,
                  none,
                  none,
                  none};
  if (side_.stretches()) {
    rates.guide_work_J = rates.guide_work_J + now.cord_lost_W;
    rates.effects_work_J = rates.effects_work_J + now.pull_on_load_N * (joint_m_per_s - v);
  }
  if constexpr (sides == 2) {
    const SideMoment<S>& other = now.opposite;
    const S& u = other.speed_m_per_s;
    rates.air_drawn_kg = rates.air_drawn_kg + other.supply_flow;
    rates.air_vented_kg = rates.air_vented_kg + other.vent_flow;
    rates.air_leaked_kg = rates.air_leaked_kg + other.leak_flow;
    rates.braid_work_J = rates.braid_work_J + other.braid_force_N * u;
    rates.thread_friction_work_J = rates.thread_friction_work_J - other.friction_force_N * u;
    rates.stop_work_J = rates.stop_work_J + other.stop_force_N * u;
    rates.effects_work_J = rates.effects_work_J + other.effects_pull_N * u;
    if (opposite_->stretches()) {
      const S end_m_per_s = opposite_->braid().rest_length_m() * opposite_stroke(state).speed_per_s;
      rates.guide_work_J = rates.guide_work_J + other.cord_lost_W;
      rates.effects_work_J = rates.effects_work_J + other.pull_on_load_N * (end_m_per_s - u);
    }
  }
  if (polytropic_) {
    rates.air_drawn_kg = rates.air_vented_kg = rates.air_leaked_kg = none;
    books_of_gas(side_, state.side, now, books.valve_air_kg, books.muscle_air_kg, rates, rates.valve_air_kg,
                 rates.muscle_air_kg);
    if constexpr (sides == 2)
      books_of_gas(*opposite_, state.opposite, now.opposite, books.opposite_valve_air_kg,
                   books.opposite_muscle_air_kg, rates, rates.opposite_valve_air_kg,
                   rates.opposite_muscle_air_kg);
  }
  return rates;
}

// With polytropic gas the pressure rates count each flow q as the enthalpy of q at the walls' temperature T.
// Gas of another temperature carries it with another mass: q T/T_gas of the volume it leaves, where
// p V = m R T_gas. Else q is the mass.
template <class P>
template <class S>
void PlantOf<P>::books_of_gas(const SideOf<P>& side, const SideState<S>& state, const SideMoment<S>& now,
                              const P& valve_air_kg, const P& muscle_air_kg, Ledger<S>& rates, S& valve_rate,
                              S& muscle_rate) const {
  const P &atmosphere = side.rig().gas.atmosphere_Pa, &RT = side.gas_energy_J_per_kg();
  const S muscle_Pa = state.muscle_pressure_Pa + atmosphere;
  S in_valve = S(1.0), in_muscle = S(1.0);  // T/T_gas
  if (any(side.rig().effects.gas_exponent() != 1.0)) {
    in_valve = valve_air_kg * RT / ((state.valve_pressure_Pa + atmosphere) * side.rig().valve.volume_m3);
    in_muscle = muscle_air_kg * RT / (muscle_Pa * now.volume_m3);
  }
  const auto carried = [](const S& flow, const S& from, const S& back) {
    return S(flow * select(flow < 0.0, back, from));
  };
  const S outside = S(1.0);
  const S drawn = carried(now.supply_flow, outside, in_valve);
  const S vented = carried(now.vent_flow, in_valve, outside);
  const S leaked = carried(now.leak_flow, in_muscle, outside);
  const S through_hose = carried(now.hose_flow, in_valve, in_muscle);
  rates.air_drawn_kg = rates.air_drawn_kg + drawn;
  rates.air_vented_kg = rates.air_vented_kg + vented;
  rates.air_leaked_kg = rates.air_leaked_kg + leaked;
  valve_rate = drawn - vented - through_hose;
  muscle_rate = through_hose - leaked;
  rates.air_inflow_J = rates.air_inflow_J + RT * (now.supply_flow - now.vent_flow - now.leak_flow);
  rates.gas_work_J = rates.gas_work_J + muscle_Pa * now.volume_slope_m3 * now.stroke.speed_per_s;
  rates.gas_heat_J = rates.gas_heat_J + now.volume_m3 * now.heating_Pa_per_s;
}

}  // namespace mckibben::plant
