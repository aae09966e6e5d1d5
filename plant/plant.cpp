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
      polytropic_(rig.effects.gas_exponent() != 1.0),
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
  // Break-away margin while sticking (a guard on the speed would rest at zero). While slipping the speed,
  // with a little to spare: a load that starts from rest the wrong way would begin at zero and never cross
  // it.
  constexpr double spare_per_s = 1e-9;
  if (held.slip == Slip::rising) return spare_per_s + state.joint.contraction_speed_per_s;
  if (held.slip == Slip::falling) return spare_per_s - state.joint.contraction_speed_per_s;
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

Ledger<double> Plant::opened(const State<double>& state) const {
  const double valve_kg =
      (state.side.valve_pressure_Pa + rig_.gas.atmosphere_Pa) * rig_.valve.volume_m3 / gas_energy_J_per_kg_;
  Ledger<double> books{};
  books.valve_air_kg = valve_kg;
  books.muscle_air_kg = gas_mass_kg(state) - valve_kg;
  return books;
}

Imbalance Plant::imbalance(const State<double>& from, const State<double>& to,
                           const Ledger<double>& books) const {
  const double first_kg = gas_mass_kg(from), all_kg = first_kg + books.air_drawn_kg;
  const double net_kg = books.air_drawn_kg - books.air_vented_kg - books.air_leaked_kg;
  double lost_kg = net_kg - (gas_mass_kg(to) - first_kg);
  if (polytropic_) {
    // p V changes by n R T of what flows in and by (1 - n) of the work done; what flows is mass as well.
    const double n = rig_.effects.gas_exponent();
    lost_kg = (n * books.air_inflow_J - (n - 1.0) * books.gas_work_J) / gas_energy_J_per_kg_ -
              (gas_mass_kg(to) - first_kg);
    const double missing_kg = net_kg - (books.valve_air_kg + books.muscle_air_kg - first_kg);
    lost_kg = std::max(std::abs(lost_kg), std::abs(missing_kg));
  }

  const double lost_J = books.braid_work_J + books.stop_work_J + books.effects_work_J -
                        books.thread_friction_work_J - books.guide_work_J -
                        (mechanical_energy_J(to) - mechanical_energy_J(from));
  // A load that hardly moved did no work to speak of: count at least that of a hundredth of the length.
  const double least_J = 0.01 * weight_N_ * braid_.rest_length_m();
  const double work_J = std::abs(books.braid_work_J) + std::abs(books.stop_work_J) +
                        std::abs(books.effects_work_J) + std::abs(books.thread_friction_work_J) +
                        std::abs(books.guide_work_J);
  return {std::abs(lost_kg) / all_kg, std::abs(lost_J) / std::max(work_J, least_J)};
}

}  // namespace mckibben::plant
