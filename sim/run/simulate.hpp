// One run of a rig under a controller, which drives a ride tick by tick.
//
//   settle: the controller's rest current is held for the settling time, then at each tick t_k = k * tick,
//   beginning with the controller's preparation at k < 0, which leaves no row:
//     counts = encoder(x-); i = DAC(controller(counts)); row k = (t_k, i, x-); the ride steps to t_(k+1)
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include <controllers/controller.hpp>
#include <plant/instruments.hpp>
#include <plant/rig.hpp>
#include <sim/domain/outer_force.hpp>
#include <sim/run/recording.hpp>
#include <sim/run/run_batch.hpp>

namespace mckibben::run {

struct RunPlan {
  plant::Rig rig;         ///< of a pair, what the hand holds is in the link
  double load_kg = 0.0;   ///< that hangs on the cord of one muscle
  std::size_t ticks = 0;  ///< rows of the recording
  plant::Noise noise{};
  std::uint64_t seed = 1, stream = 0;  ///< runs of one seed differ by their stream
  bool keep_ledger = false;
  std::vector<domain::OuterForce> outer_forces{};  ///< on the cord, in order of time
};

/// Simulates one run. If the integrator or the controller gives up, the recording ends there and says why.
/// Touches no heap between the first tick and the last.
Recording simulate(const RunPlan& plan, controllers::Controller& controller);

/// What a controller found out, named by what the rig's valve takes.
std::vector<controllers::Finding> findings_for(const controllers::Controller& controller,
                                               const plant::Rig& rig);

/// A run that is asked for, and what drives it.
struct Order {
  RunPlan plan;
  std::unique_ptr<controllers::Controller> controller;
};
using Ordering = std::function<Order(std::size_t index)>;
using Finished = std::function<void(std::size_t index, Recording recording)>;

/// Simulates many runs on `threads` threads (0: all the machine has), several times quicker than one by one:
/// in batches, but for pairs and runs with exact stick and slip, with CVODE, or with a ledger of a gas that
/// has a temperature. A recording depends neither on threads nor on what shares the batch, and a run that
/// fails, fails alone; alone (`simulate`) it is the same within the rounding of its laws. `ordering` and
/// `finished` are called from any thread, in any order. Throws Interrupted; what they throw.
void simulate_all(std::size_t count, unsigned threads, const Ordering& ordering, const Finished& finished);

/// The same of runs that `take` hands out, from any thread; `about`: how many at most. Ends when
/// there are none.
void simulate_all(const Take& take, std::size_t about, unsigned threads, const Ordering& ordering,
                  const Finished& finished);

/// What the data sheets of a rig tell a controller, and the target at each tick [contraction ratio; of a pair
/// R theta/l0]. Nothing of its effects. Without `reach`, which takes a moment to compute (`reachable`), and
/// the stiffness that is wanted of a pair.
controllers::Knowledge knowledge_of(const plant::Rig& rig, std::vector<double> target);

/// Contraction ratio of one encoder count.
double contraction_per_count(const plant::Rig& rig);

}  // namespace mckibben::run
