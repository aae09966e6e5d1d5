// One run of a rig under a controller, which drives a ride tick by tick.
//
//   settle: the controller's rest current is held for the settling time, then at each tick t_k = k * tick,
//   beginning with the controller's preparation at k < 0, which leaves no row:
//     counts = encoder(x-); i = DAC(controller(counts)); row k = (t_k, i, x-); the ride steps to t_(k+1)
#pragma once

#include <cstddef>
#include <cstdint>

#include <controllers/controller.hpp>
#include <plant/instruments.hpp>
#include <plant/rig.hpp>
#include <sim/run/recording.hpp>
#include <sim/solver/settings.hpp>

namespace mckibben::run {

struct RunPlan {
  plant::Rig rig;
  double load_kg = 0.0;
  std::size_t ticks = 0;  ///< rows of the recording
  solver::Settings engine{};
  plant::Noise noise{};
  std::uint64_t seed = 1, stream = 0;  ///< runs of one seed differ by their stream
  bool keep_ledger = false;
};

/// Simulates one run. If the integrator or the controller gives up, the recording ends there and says why.
/// Touches no heap between the first tick and the last.
Recording simulate(const RunPlan& plan, controllers::Controller& controller);

/// What the data sheets of a rig tell a controller, and the target [contraction ratio] at each tick. Nothing
/// of its effects.
/// Without `reach`, which takes a moment to compute: see `reachable`.
controllers::Knowledge knowledge_of(const plant::Rig& rig, std::vector<double> target);

/// Contraction ratio of one encoder count.
double contraction_per_count(const plant::Rig& rig);

}  // namespace mckibben::run
