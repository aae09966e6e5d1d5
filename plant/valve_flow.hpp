// What a valve and its hose pass (ISO 6358), by the pressures at their ends and by what is asked of the
// valve. The muscle behind the hose is a pressure, no more; side.hpp has the rest of it.
#pragma once

#include <cmath>
#include <concepts>
#include <numbers>

#include <plant/flow.hpp>
#include <plant/rig.hpp>
#include <plant/state.hpp>

namespace mckibben::plant {

/// A conductance holds at the reference temperature; warmer gas is thinner.
template <class P>
RestrictionOf<P> restriction(const RigOf<P>& rig, const P& conductance_m3_per_s_Pa) {
  using std::sqrt;
  constexpr double reference_temperature_K = 293.15;
  const P warmth = sqrt(reference_temperature_K / rig.gas.temperature_K);
  return {conductance_m3_per_s_Pa * rig.gas.reference_density_kg_per_m3 * warmth, rig.valve.critical_ratio,
          rig.hose.linear_zone_Pa};
}

/// Flows in kg/s.
template <class S>
struct ValveMoment {
  S pressure_error_Pa;                  // what the valve acts on: P_ref - P_v, less its dead band
  S wanted_opening, valve_opening;      // u, -1 (venting) to 1 (filling): before and after effects
  S supply_flow, vent_flow, hose_flow;  // q_v = supply_flow - vent_flow, q_h
};

/// Absolute pressures at both ends of the hose.
template <class S>
struct HoseEnds {
  S valve_Pa, muscle_Pa;
};

template <class P>
class ValveFlowOf {
 public:
  explicit ValveFlowOf(const RigOf<P>& rig);

  /// Pressure error opens one of two proportional valves (T 3.1), in proportion to it, or so far that the
  /// pressure follows with a regulator's lag. `effects`: null if there are none.
  template <class S, class H>
  ValveMoment<S> proportional(const HoseEnds<S>& ends, S error_Pa, const SideMemory<S>& memory,
                              const HeldSideOf<H>& held, const EffectsOf<P>* effects) const;
  /// One valve to the supply, one to the atmosphere, each open or shut; both may be either at once.
  template <class S, class H>
  ValveMoment<S> switched(const HoseEnds<S>& ends, const SideMemory<S>& memory, const HeldSideOf<H>& held,
                          const EffectsOf<P>* effects) const;
  /// Whatever keeps a given pressure of the valve brings the gas that this takes.
  template <class S, class H>
  ValveMoment<S> kept(const HoseEnds<S>& ends, const HeldSideOf<H>& held, const EffectsOf<P>* effects) const;

  /// How fast a regulator of second order comes to follow an error.
  template <class S>
  S memory_rate(const S& error_Pa, const SideMemory<S>& memory) const {
    return catching_up_per_s_ * (error_Pa - memory[regulator_memory]);
  }
  /// dP_v/dt of an isothermal gas.
  template <class S>
  S pressure_rate_Pa_per_s(const ValveMoment<S>& now) const {
    return stiffness_Pa_per_kg_ * (now.supply_flow - now.vent_flow - now.hose_flow);
  }

  bool swings() const { return swings_; }
  bool switches() const { return switches_; }
  /// R T [J/kg].
  const P& gas_energy_J_per_kg() const { return gas_energy_J_per_kg_; }

 private:
  template <class S>
  S flow_to_follow(const SideMemory<S>& memory, const S& error_Pa, const S& hose_flow,
                   const EffectsOf<P>* effects) const;
  template <class S, class H>
  S supply_Pa(const SideMemory<S>& memory, const HeldSideOf<H>& held, const EffectsOf<P>* effects) const {
    const S supply_Pa = S(supply_Pa_ + held.supply_above_Pa);
    return effects ? S(supply_Pa - effects->supply_drop_Pa(memory)) : supply_Pa;
  }
  static P gas_exponent(const EffectsOf<P>* effects) { return effects ? effects->gas_exponent() : P(1.0); }

  /// A valve between equal pressures can pass nothing: what is wanted is not divided by less.
  static constexpr double least_flow_kg_per_s = 1e-9;

  bool regulates_, swings_, switches_;
  RestrictionOf<P> valve_, vent_, hose_;
  P leak_kg_per_s_Pa_;  // of valves that are shut
  P supply_Pa_, exhaust_Pa_;
  P proportional_band_Pa_, volume_m3_, gas_energy_J_per_kg_, stiffness_Pa_per_kg_;
  ValveDeadBandOf<P> dead_band_;
  P quickness_per_s_, catching_up_per_s_;  // of a regulator: dP_v/dt for an error, the memory's for its own
};
using ValveFlow = ValveFlowOf<double>;

template <class P>
ValveFlowOf<P>::ValveFlowOf(const RigOf<P>& rig)
    : regulates_(rig.valve.is_regulator()),
      swings_(rig.valve.swings()),
      switches_(rig.valve.is_on_off()),
      valve_(restriction(rig, rig.valve.conductance_m3_per_s_Pa)),
      vent_(valve_),
      hose_(restriction(rig, P(static_cast<double>(rig.muscle.count) * rig.hose.conductance_m3_per_s_Pa))),
      leak_kg_per_s_Pa_(restriction(rig, rig.valve.leak_m3_per_s_Pa).conductance_kg_per_s_Pa),
      supply_Pa_(rig.valve.supply_pressure_Pa + rig.gas.atmosphere_Pa),
      exhaust_Pa_(rig.valve.exhaust_pressure_Pa + rig.gas.atmosphere_Pa),
      proportional_band_Pa_(rig.valve.proportional_band_Pa),
      volume_m3_(rig.valve.volume_m3),
      gas_energy_J_per_kg_(rig.gas.gas_constant_J_per_kg_K * rig.gas.temperature_K),
      stiffness_Pa_per_kg_(gas_energy_J_per_kg_ / volume_m3_),
      dead_band_{rig.valve.dead_band_Pa},
      quickness_per_s_(1.0),
      catching_up_per_s_(1.0) {
  const P& venting = rig.valve.venting_conductance_m3_per_s_Pa;
  vent_ = restriction(
      rig, P(rig.effects.vent_factor() * select(venting > 0.0, venting, rig.valve.conductance_m3_per_s_Pa)));
  const P& venting_ratio = rig.valve.venting_critical_ratio;
  if (switches_) vent_.critical_ratio = select(venting_ratio > 0.0, venting_ratio, rig.valve.critical_ratio);
  const P swing_per_s = 2.0 * std::numbers::pi * rig.valve.natural_frequency_Hz;
  if (swings_) catching_up_per_s_ = 2.0 * rig.valve.damping * swing_per_s;
  if (regulates_)
    quickness_per_s_ =
        swings_ ? P(swing_per_s * swing_per_s / catching_up_per_s_) : P(1.0 / rig.valve.time_constant_s);
}

// Air for the volume, whose pressure is to change by the error over the lag's time, and for the hose.
template <class P>
template <class S>
S ValveFlowOf<P>::flow_to_follow(const SideMemory<S>& memory, const S& error_Pa, const S& hose_flow,
                                 const EffectsOf<P>* effects) const {
  const S followed_Pa = swings_ ? memory[regulator_memory] : error_Pa;
  return followed_Pa * (quickness_per_s_ * volume_m3_ / (gas_exponent(effects) * gas_energy_J_per_kg_)) +
         hose_flow;
}

template <class P>
template <class S, class H>
ValveMoment<S> ValveFlowOf<P>::proportional(const HoseEnds<S>& ends, S error_Pa, const SideMemory<S>& memory,
                                            const HeldSideOf<H>& held, const EffectsOf<P>* effects) const {
  ValveMoment<S> now;
  if (regulates_) error_Pa = error_Pa + dead_band_.valve_error_shift_Pa(error_Pa);
  if (effects) error_Pa = error_Pa + effects->valve_error_shift_Pa(error_Pa);
  const S supply_Pa = this->supply_Pa(memory, held, effects);
  now.pressure_error_Pa = error_Pa;
  now.hose_flow = hose_.flow_kg_per_s(ends.valve_Pa, ends.muscle_Pa);
  // What the valve passes where it is wide open to the supply, or to the atmosphere.
  const auto wide_open = [&](const auto& fills) {
    return RestrictionOf<P>{select(fills, valve_.conductance_kg_per_s_Pa, vent_.conductance_kg_per_s_Pa),
                            valve_.critical_ratio, valve_.linear_zone_Pa}
        .flow_kg_per_s(S(select(fills, supply_Pa, ends.valve_Pa)),
                       S(select(fills, ends.valve_Pa, S(exhaust_Pa_))));
  };
  S u;
  if (regulates_) {
    const S flow = flow_to_follow(memory, error_Pa, now.hose_flow, effects);
    const S most = wide_open(flow >= 0.0);
    u = flow / select(most > least_flow_kg_per_s, most, S(least_flow_kg_per_s));
  } else {
    u = error_Pa / proportional_band_Pa_;
  }
  u = select(u > 1.0, S(1.0), u);
  u = select(u < -1.0, S(-1.0), u);
  now.wanted_opening = u;
  if (effects) u = effects->valve_opening(now.wanted_opening, memory);
  now.valve_opening = u;
  const auto fills = u >= 0.0;
  const S flow = u * wide_open(fills);
  now.supply_flow = select(fills, flow, S(0.0));
  now.vent_flow = select(fills, S(0.0), S(-flow));
  return now;
}

template <class P>
template <class S, class H>
ValveMoment<S> ValveFlowOf<P>::switched(const HoseEnds<S>& ends, const SideMemory<S>& memory,
                                        const HeldSideOf<H>& held, const EffectsOf<P>* effects) const {
  const auto through = [this](const RestrictionOf<P>& open, const H& share, const S& from, const S& to) {
    RestrictionOf<P> leak = open;
    leak.conductance_kg_per_s_Pa = leak_kg_per_s_Pa_;
    return S(share * open.flow_kg_per_s(from, to) + (1.0 - share) * leak.flow_kg_per_s(from, to));
  };
  const S opening = S(held.fills - held.vents);
  return {S(0.0),
          opening,
          opening,
          through(valve_, held.fills, supply_Pa(memory, held, effects), ends.valve_Pa),
          through(vent_, held.vents, ends.valve_Pa, S(exhaust_Pa_)),
          hose_.flow_kg_per_s(ends.valve_Pa, ends.muscle_Pa)};
}

template <class P>
template <class S, class H>
ValveMoment<S> ValveFlowOf<P>::kept(const HoseEnds<S>& ends, const HeldSideOf<H>& held,
                                    const EffectsOf<P>* effects) const {
  const S hose_flow = hose_.flow_kg_per_s(ends.valve_Pa, ends.muscle_Pa);
  const S supply_flow =
      hose_flow + volume_m3_ * (held.pressure_rate_Pa_per_s / gas_exponent(effects)) / gas_energy_J_per_kg_;
  return {S(0.0), S(0.0), S(0.0), supply_flow, S(0.0), hose_flow};
}

}  // namespace mckibben::plant
