// What instruments would read in a measured run, if the rig were this one: the run's recorded current sent
// through several rigs side by side, and how the readings change with parameters.
#pragma once

#include <span>
#include <vector>

#include <plant/rig.hpp>
#include <plant/state.hpp>
#include <sim/diagnose/parameter.hpp>
#include <sim/input/dataset.hpp>

namespace mckibben::diagnose {

/// A rig with a load [kg] on it.
struct Hanging {
  plant::Rig rig;
  double load_kg;
};

/// At each tick, before counting.
struct Readings {
  std::vector<double> contraction_ratio;
  std::vector<double> pressure_Pa;
  std::vector<plant::State<double>> states;  ///< of the first rig only
};

/// Readings of up to engine::Flock::most rigs in common steps. The ticks are those of the first rig. Throws
/// engine::NumericalFailure.
std::vector<Readings> predict(const input::Run& run, std::span<const Hanging> rigs);

/// Tolerance of these simulations: their error in e, some 5e-6, is far below a count.
inline constexpr double tolerance = 1e-5;

}  // namespace mckibben::diagnose
