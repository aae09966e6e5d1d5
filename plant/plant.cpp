// What of the plant needs no dual numbers: constants, start, domain, stick and slip, balances for audits.
#include <algorithm>

#include <plant/plant.hpp>

namespace mckibben::plant {
namespace {

/// ISO 6358: a conductance holds at the reference temperature; warmer gas is thinner.
Restriction restriction(const Rig& rig, double conductance_m3_per_s_Pa) {
  constexpr double reference_temperature_K = 293.15;
  const double warmth = std::sqrt(reference_temperature_K / rig.gas.temperature_K);
  return {conductance_m3_per_s_Pa * rig.gas.reference_density_kg_per_m3 * warmth, rig.valve.critical_ratio,
          rig.hose.linear_zone_Pa};
}

}  // namespace

Plant::Plant(const Rig& rig, double load_kg)
    : rig_(rig),
      braid_(rig.muscle),
      valve_(restriction(rig, rig.valve.conductance_m3_per_s_Pa)),
      hose_(restriction(rig, rig.hose.conductance_m3_per_s_Pa)),
      unit_flow_(restriction(rig, 1.0)),
      effects_(!rig.effects.absent()),
      remembers_(rig.effects.remember()),
      mass_kg_(load_kg + rig.joint.load_offset_kg +
               rig.joint.wheel_inertia_kg_m2 / (rig.joint.wheel_radius_m * rig.joint.wheel_radius_m)),
      weight_N_((load_kg + rig.joint.load_offset_kg) * gravity_m_per_s2),
      gas_energy_J_per_kg_(rig.gas.gas_constant_J_per_kg_K * rig.gas.temperature_K),
      supply_Pa_(rig.valve.supply_pressure_Pa + rig.gas.atmosphere_Pa) {}

double Plant::reference_pressure_Pa(double current_mA) const {
  const Valve& valve = rig_.valve;
  const double slope =
      (valve.span_pressure_Pa - valve.zero_pressure_Pa) / (valve.span_current_mA - valve.zero_current_mA);
  return std::clamp(valve.zero_pressure_Pa + slope * (current_mA - valve.zero_current_mA),
                    valve.zero_pressure_Pa, valve.span_pressure_Pa);
}

State<double> Plant::at_rest(const Held& held) const {
  return {{0.0, 0.0}, {held.reference_pressure_Pa, held.reference_pressure_Pa, 0.0}};
}

double Plant::event_margin(const State<double>& state, const Memory<double>& memory, const Held& held) const {
  // Break-away margin while sticking (a guard on the speed would rest at zero), the speed while slipping.
  if (held.slip == Slip::rising) return state.joint.contraction_speed_per_s;
  if (held.slip == Slip::falling) return -state.joint.contraction_speed_per_s;
  const auto now = moment(state, memory, held);
  return now.friction_level_N - std::abs(now.friction_force_N);
}

Slip Plant::slip_from_rest(State<double>& state, const Memory<double>& memory, const Held& held) const {
  state.joint.contraction_speed_per_s = 0.0;
  Held stuck = held;
  stuck.slip = Slip::sticking;
  const auto now = moment(state, memory, stuck);
  const double pulled_N = -now.friction_force_N;  // all other forces
  // An event is located to rounding only: a margin that is zero but for that means the load has broken away.
  const bool holds = std::abs(pulled_N) < now.friction_level_N * (1.0 - 1e-9);
  if (holds) return Slip::sticking;
  return pulled_N > 0.0 ? Slip::rising : Slip::falling;
}

double Plant::gas_mass_kg(const State<double>& state) const {
  const double atmosphere = rig_.gas.atmosphere_Pa;
  return ((state.side.valve_pressure_Pa + atmosphere) * rig_.valve.volume_m3 +
          (state.side.muscle_pressure_Pa + atmosphere) * braid_.volume_m3(state.joint.contraction_ratio)) /
         gas_energy_J_per_kg_;
}

double Plant::mechanical_energy_J(const State<double>& state) const {
  const double length = braid_.rest_length_m();
  const double speed = length * state.joint.contraction_speed_per_s;
  return 0.5 * mass_kg_ * speed * speed + weight_N_ * length * state.joint.contraction_ratio;
}

}  // namespace mckibben::plant
