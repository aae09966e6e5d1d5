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
  if (!problem.plant().in_domain(at)) return false;
  const auto seed = [](double value, int index) { return Number::unknown(value, index); };
  const plant::State<Number> state{
      {seed(at.joint.contraction_ratio, 0), seed(at.joint.contraction_speed_per_s, 1)},
      {seed(at.side.valve_pressure_Pa, 2), seed(at.side.muscle_pressure_Pa, 3), seed(at.side.bristle_m, 4)}};
  plant::Memory<Number> memory;
  memory.fill(0.0);
  if constexpr (L::remembers) {
    for (int i = 0; i < static_cast<int>(plant::memory_size); ++i)
      memory[static_cast<std::size_t>(i)] = seed(y[plant::state_size + i], plant::state_size + i);
  }
  const auto now = problem.plant().moment(state, memory, problem.held);
  const auto rates = problem.plant().rates(state, now);
  int next = 0;
  const auto row = [&](const Number& rate) {
    result.row(next).setZero();
    result.row(next++).template head<L::steering>() = rate.slopes.transpose();
  };
  row(rates.joint.contraction_ratio);
  row(rates.joint.contraction_speed_per_s);
  row(rates.side.valve_pressure_Pa);
  row(rates.side.muscle_pressure_Pa);
  row(rates.side.bristle_m);
  if constexpr (L::remembers)
    for (const Number& rate : now.memory_rates) row(rate);
  if constexpr (L::audits) {
    const auto ledger = problem.plant().ledger_rates(state, now, Problem<L>::ledger_of(y));
    row(ledger.air_drawn_kg);
    row(ledger.air_vented_kg);
    row(ledger.air_leaked_kg);
    row(ledger.braid_work_J);
    row(ledger.thread_friction_work_J);
    row(ledger.guide_work_J);
    row(ledger.stop_work_J);
    row(ledger.effects_work_J);
    if constexpr (L::entries == plant::ledger_size) {  // of the gas that is there already it makes little
      row(ledger.valve_air_kg);
      row(ledger.muscle_air_kg);
      row(ledger.air_inflow_J);
      row(ledger.gas_work_J);
    }
  }
  return true;
}

}  // namespace mckibben::engine
