// The integrator gave up: when, where and why.
#pragma once

#include <stdexcept>
#include <string>

#include <plant/state.hpp>

namespace mckibben::engine {

/// Thrown when the solver cannot go on. `what()` names time, state, solver and likely cause.
class NumericalFailure : public std::runtime_error {
 public:
  NumericalFailure(double time_s, const plant::State<double>& state, const std::string& cause);

  double time_s;  ///< below zero: while the rig settled
  plant::State<double> state;
  std::string cause;
};

}  // namespace mckibben::engine
