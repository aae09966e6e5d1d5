// Exact Jacobian of the plant by forward differentiation: the same equations, evaluated on dual numbers.
#pragma once

#include <Eigen/Core>

#include <plant/plant.hpp>
#include <sim/engine/problem.hpp>

#include <unsupported/Eigen/AutoDiff>

namespace mckibben::engine {

using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, plant::state_size, 1>>;

/// d(dy/dt)/dy of state and, where carried, ledger [SI units of each]; false outside the domain of the laws.
/// At a kink (valve closing, stop touched, v = 0) it is the derivative of the side the state stands on.
template <int N, class Matrix>
bool jacobian(const Problem<N>& problem, const double* y, Matrix& result) {
  const auto at = Problem<N>::state_of(y);
  if (!problem.plant().in_domain(at)) return false;
  const auto seed = [](double value, int index) { return Dual(value, plant::state_size, index); };
  const plant::State<Dual> state{
      {seed(at.joint.contraction_ratio, 0), seed(at.joint.contraction_speed_per_s, 1)},
      {seed(at.side.valve_pressure_Pa, 2), seed(at.side.muscle_pressure_Pa, 3), seed(at.side.bristle_m, 4)}};
  const auto now = problem.plant().moment(state, problem.held);
  const auto rates = problem.plant().rates(state, now);
  const auto row = [&](int i, const Dual& rate) {
    result.row(i).setZero();
    result.row(i).template head<plant::state_size>() = rate.derivatives().transpose();
  };
  row(0, rates.joint.contraction_ratio);
  row(1, rates.joint.contraction_speed_per_s);
  row(2, rates.side.valve_pressure_Pa);
  row(3, rates.side.muscle_pressure_Pa);
  row(4, rates.side.bristle_m);
  if constexpr (Problem<N>::keeps_ledger) {
    const auto ledger = problem.plant().ledger_rates(now);
    row(5, ledger.air_drawn_kg);
    row(6, ledger.air_vented_kg);
    row(7, ledger.braid_work_J);
    row(8, ledger.thread_friction_work_J);
    row(9, ledger.guide_work_J);
    row(10, ledger.stop_work_J);
  }
  return true;
}

}  // namespace mckibben::engine
