// Exact Jacobian of the plant by forward differentiation: the same equations, evaluated on dual numbers.
#pragma once

#include <plant/plant.hpp>
#include <sim/engine/dual.hpp>
#include <sim/engine/problem.hpp>

namespace mckibben::engine {

/// State and memory at y as numbers of which each is an unknown, in the order of y; `more` are to follow.
template <class L, int more = 0>
struct Unknowns {
  using Number = Dual<L::steering + more>;

  plant::State<Number> state;
  plant::Memory<Number> memory;

  Unknowns(const plant::State<double>& at, const double* y) {
    state.joint.contraction_ratio = next(at.joint.contraction_ratio);
    state.joint.contraction_speed_per_s = next(at.joint.contraction_speed_per_s);
    side(at.side, state.side);
    if constexpr (L::sides == 2) side(at.opposite, state.opposite);
    memory.side.fill(0.0);
    memory.opposite.fill(0.0);
    for (std::size_t i = 0; i < L::of_side; ++i) memory.side[i] = next(y[count_]);
    for (std::size_t i = 0; L::sides == 2 && i < L::of_side; ++i) memory.opposite[i] = next(y[count_]);
  }

  /// The unknown that comes next.
  Number next(double value) { return Number::unknown(value, count_++); }

 private:
  void side(const plant::SideState<double>& at, plant::SideState<Number>& seeded) {
    seeded.valve_pressure_Pa = next(at.valve_pressure_Pa);
    seeded.muscle_pressure_Pa = next(at.muscle_pressure_Pa);
    seeded.bristle_m = next(at.bristle_m);
  }

  int count_ = 0;
};

/// Calls `row` with the rates of all that steers, in the order of y.
template <class L, class Rates, class Moment, class Row>
void for_each_rate(const Rates& rates, const Moment& now, const Row& row) {
  row(rates.joint.contraction_ratio);
  row(rates.joint.contraction_speed_per_s);
  const auto side = [&](const auto& of) {
    row(of.valve_pressure_Pa);
    row(of.muscle_pressure_Pa);
    row(of.bristle_m);
  };
  side(rates.side);
  if constexpr (L::sides == 2) side(rates.opposite);
  for (std::size_t i = 0; i < L::of_side; ++i) row(now.memory_rates[i]);
  if constexpr (L::sides == 2)
    for (std::size_t i = 0; i < L::of_side; ++i) row(now.opposite.memory_rates[i]);
}

/// The same with those of the ledger.
template <class L, class Ledger, class Row>
void for_each_entry(const Ledger& ledger, const Row& row) {
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
    row(ledger.gas_heat_J);
    row(ledger.opposite_valve_air_kg);
    row(ledger.opposite_muscle_air_kg);
  }
}

/// d(dy/dt)/dy of all components [SI units of each]; false outside the domain of the laws. At a kink (valve
/// closing, stop touched, v = 0) it is the derivative of the side the state stands on.
template <class L, class Matrix>
bool jacobian(const Problem<L>& problem, const double* y, Matrix& result) {
  const auto& plant = problem.plant();
  const auto at = Problem<L>::state_of(y);
  if (!plant.template in_domain<L::sides>(at, Problem<L>::memory_of(y))) return false;
  const Unknowns<L> unknowns(at, y);
  const auto now = plant.template moment<L::sides>(unknowns.state, unknowns.memory, problem.held);
  const auto rates = plant.template rates<L::sides>(unknowns.state, now);
  int next = 0;
  const auto row = [&](const Dual<L::steering>& rate) {
    result.row(next).setZero();
    result.row(next++).template head<L::steering>() = rate.slopes.transpose();
  };
  for_each_rate<L>(rates, now, row);
  if constexpr (L::audits)
    for_each_entry<L>(plant.template ledger_rates<L::sides>(unknowns.state, now, Problem<L>::ledger_of(y)),
                      row);
  return true;
}

}  // namespace mckibben::engine
