// What a side precomputes, and what is asked of it between instants.
#include <algorithm>

#include <plant/side.hpp>

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

Side::Side(const Rig& rig, double weight_N)
    : rig_(rig),
      braid_(rig.muscle),
      valve_(restriction(rig, rig.valve.conductance_m3_per_s_Pa)),
      hose_(restriction(rig, rig.hose.conductance_m3_per_s_Pa)),
      unit_flow_(restriction(rig, 1.0)),
      effects_(!rig.effects.absent()),
      weight_N_(weight_N),
      gas_energy_J_per_kg_(rig.gas.gas_constant_J_per_kg_K * rig.gas.temperature_K),
      supply_Pa_(rig.valve.supply_pressure_Pa + rig.gas.atmosphere_Pa) {}

double Side::reference_pressure_Pa(double current_mA) const {
  const Valve& valve = rig_.valve;
  const double slope =
      (valve.span_pressure_Pa - valve.zero_pressure_Pa) / (valve.span_current_mA - valve.zero_current_mA);
  return std::clamp(valve.zero_pressure_Pa + slope * (current_mA - valve.zero_current_mA),
                    valve.zero_pressure_Pa, valve.span_pressure_Pa);
}

double Side::air_kg(double contraction_ratio, const SideState<double>& state) const {
  const double atmosphere = rig_.gas.atmosphere_Pa;
  return ((state.valve_pressure_Pa + atmosphere) * rig_.valve.volume_m3 +
          (state.muscle_pressure_Pa + atmosphere) * braid_.volume_m3(contraction_ratio)) /
         gas_energy_J_per_kg_;
}

double Side::valve_air_kg(const SideState<double>& state) const {
  return (state.valve_pressure_Pa + rig_.gas.atmosphere_Pa) * rig_.valve.volume_m3 / gas_energy_J_per_kg_;
}

}  // namespace mckibben::plant
