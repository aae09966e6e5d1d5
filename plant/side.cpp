// What a side precomputes, and what is asked of it between instants.

#include <algorithm>

#include <plant/side.hpp>

namespace mckibben::plant {

namespace {

double slope_Pa_per_mA(const Valve& valve) {
  return (valve.span_pressure_Pa - valve.zero_pressure_Pa) / (valve.span_command - valve.zero_command);
}

}  // namespace

template <class P>
double SideOf<P>::reference_pressure_Pa(double current_mA) const {
  const Valve& valve = rig_.valve;
  return std::clamp(valve.zero_pressure_Pa + slope_Pa_per_mA(valve) * (current_mA - valve.zero_command),
                    valve.zero_pressure_Pa, valve.span_pressure_Pa);
}

template <class P>
double SideOf<P>::reference_slope_Pa_per_mA(double current_mA) const {
  const Valve& valve = rig_.valve;
  const bool trimmed = current_mA < valve.zero_command || current_mA > valve.span_command;
  return trimmed ? 0.0 : slope_Pa_per_mA(valve);
}

template <class P>
double SideOf<P>::air_kg(const Stroke<double>& joint, const SideState<double>& state,
                         const SideMemory<double>& memory) const {
  const double atmosphere = rig_.gas.atmosphere_Pa;
  return ((state.valve_pressure_Pa + atmosphere) * rig_.valve.volume_m3 +
          (state.muscle_pressure_Pa + atmosphere) *
              braid_.volume_m3(stroke(joint, memory).contraction_ratio)) /
         gas_energy_J_per_kg();
}

template <class P>
double SideOf<P>::valve_air_kg(const SideState<double>& state) const {
  return (state.valve_pressure_Pa + rig_.gas.atmosphere_Pa) * rig_.valve.volume_m3 / gas_energy_J_per_kg();
}

template <class P>
double SideOf<P>::reading_shift_m(const Stroke<double>& stroke, const SideState<double>& state,
                                  const SideMemory<double>& memory, const HeldSide& held) const {
  if (rig_.effects.laws.list.empty()) return 0.0;
  SideMoment<double> now{};
  now.speed_m_per_s = braid_.rest_length_m() * stroke.speed_per_s;
  return rig_.effects.reading_shift_m(instant(stroke, state, held, now), memory);
}

template <class P>
std::string_view SideOf<P>::law_without_number(const Stroke<double>& stroke,
                                               const SideState<double>& state) const {
  SideMoment<double> now{};
  now.speed_m_per_s = braid_.rest_length_m() * stroke.speed_per_s;
  const HeldSide held{.reference_pressure_Pa = state.valve_pressure_Pa};
  return rig_.effects.laws.without_number(instant(stroke, state, held, now));
}

template class SideOf<double>;

}  // namespace mckibben::plant
