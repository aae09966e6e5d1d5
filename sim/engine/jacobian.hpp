// Exact Jacobian of the plant by forward differentiation: the same equations, evaluated on dual numbers.
#pragma once

#include <plant/plant.hpp>
#include <sim/engine/dual.hpp>
#include <sim/engine/problem.hpp>

namespace mckibben::engine {

/// d(dy/dt)/dy of all components [SI units of each]; false outside the domain of the laws. At a kink (valve
/// closing, stop touched, v = 0) it is the derivative of the side the state stands on.
template <class L, class Matrix>
bool jacobian(const Problem<L>& problem, const double* y, Matrix& result) {
  using Number = Dual<L::steering>;
  const auto at = Problem<L>::state_of(y);
  if (!problem.plant().template in_domain<L::sides>(at)) return false;
  int unknowns = 0;
  const auto seed = [&](double value) { return Number::unknown(value, unknowns++); };
  const auto side_of = [&](const plant::SideState<double>& side) {
    plant::SideState<Number> seeded;
    seeded.valve_pressure_Pa = seed(side.valve_pressure_Pa);
    seeded.muscle_pressure_Pa = seed(side.muscle_pressure_Pa);
    seeded.bristle_m = seed(side.bristle_m);
    return seeded;
  };
  plant::State<Number> state;
  state.joint.contraction_ratio = seed(at.joint.contraction_ratio);
  state.joint.contraction_speed_per_s = seed(at.joint.contraction_speed_per_s);
  state.side = side_of(at.side);
  if constexpr (L::sides == 2) state.opposite = side_of(at.opposite);
  plant::Memory<Number> memory;
  memory.side.fill(0.0);
  memory.opposite.fill(0.0);
  if constexpr (L::remembers) {
    for (Number& one : memory.side) one = seed(y[unknowns]);
    if constexpr (L::sides == 2)
      for (Number& one : memory.opposite) one = seed(y[unknowns]);
  }
  const auto now = problem.plant().template moment<L::sides>(state, memory, problem.held);
  const auto rates = problem.plant().template rates<L::sides>(state, now);
  int next = 0;
  const auto row = [&](const Number& rate) {
    result.row(next).setZero();
    result.row(next++).template head<L::steering>() = rate.slopes.transpose();
  };
  row(rates.joint.contraction_ratio);
  row(rates.joint.contraction_speed_per_s);
  const auto rows_of = [&](const plant::SideState<Number>& side) {
    row(side.valve_pressure_Pa);
    row(side.muscle_pressure_Pa);
    row(side.bristle_m);
  };
  rows_of(rates.side);
  if constexpr (L::sides == 2) rows_of(rates.opposite);
  if constexpr (L::remembers) {
    for (const Number& rate : now.memory_rates) row(rate);
    if constexpr (L::sides == 2)
      for (const Number& rate : now.opposite.memory_rates) row(rate);
  }
  if constexpr (L::audits) {
    const auto ledger = problem.plant().template ledger_rates<L::sides>(state, now, Problem<L>::ledger_of(y));
    row(ledger.air_drawn_kg);
    row(ledger.air_vented_kg);
    row(ledger.air_leaked_kg);
    row(ledger.braid_work_J);
    row(ledger.thread_friction_work_J);
    row(ledger.guide_work_J);
    row(ledger.stop_work_J);
    row(ledger.effects_work_J);
    row(ledger.bench_work_J);
    if constexpr (L::entries == plant::ledger_size) {  // of the gas that is there already it makes little
      row(ledger.valve_air_kg);
      row(ledger.muscle_air_kg);
      row(ledger.air_inflow_J);
      row(ledger.gas_work_J);
      row(ledger.opposite_valve_air_kg);
      row(ledger.opposite_muscle_air_kg);
    }
  }
  return true;
}

}  // namespace mckibben::engine
