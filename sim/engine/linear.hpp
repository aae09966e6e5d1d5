// The rig near a point, as courses on control have it:
//
//   dx/dt = rate + A (x - state) + B (u - input)      y = output + C (x - state) + D (u - input)
//
// exact, by the dual numbers that give CVODE its Jacobian; at a kink (a valve that closes, a stop that is
// touched, standstill in the threads) it is the side on which the state stands.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <sim/engine/problem.hpp>

namespace mckibben::engine {

struct Signal {
  std::string name;  ///< with the unit at its end
  std::string unit;  ///< "1" for a ratio
};

struct Linear {
  /// e, de/dt; P_v, P_m, z of the muscle, of each of a pair; what effects and regulators that are at work
  /// remember.
  std::vector<Signal> states;
  /// The current and its speed (T 4.6), of a pair both of each; a force that lifts the load, or a torque on a
  /// pair's joint. In reach of the valve's line: plays and delays of commands are not in it.
  std::vector<Signal> inputs;
  /// True values: e, or a pair's angle; P_m and the cord's force of each muscle.
  std::vector<Signal> outputs;
  Eigen::VectorXd state, rate, input, output;  ///< at the point
  Eigen::MatrixXd A, B, C, D;
};

/// At a state, with what is held there; `current_mA`: to the valve of each muscle. Throws
/// std::invalid_argument where a pressure or the length is given, where a load sticks (Coulomb), and outside
/// the domain of the laws.
Linear linearise(const plant::Plant& plant, const Flow& at, const plant::Held& held,
                 const std::array<double, 2>& current_mA);

}  // namespace mckibben::engine
