// The one interface behind which a SUNDIALS method carries the plant from instant to instant.
#pragma once

#include <memory>

#include <plant/solver.hpp>
#include <sim/engine/problem.hpp>

namespace mckibben::engine {

using solver::Method, solver::Settings;

/// What the solver did since it was made.
struct Counters {
  long steps = 0, rejected_steps = 0, right_hand_sides = 0, jacobians = 0, events = 0;
  long stiff_from_tick = -1;  ///< ticks carried before `automatic` went over to CVODE; -1: never
};

/// A rig counts as stiff once its ticks, over this many of them, take more evaluations than that, each: BDF
/// is cheaper then.
inline constexpr long window_ticks = 20, stiff_cost_per_tick = 600;

/// What was done between two readings of one integrator.
Counters operator-(const Counters& later, const Counters& earlier);
/// What two integrators did, one after the other.
Counters operator+(const Counters& earlier, const Counters& later);

/// What an integrator keeps from one instant to the next beside the flow: another one of the same plant and
/// settings that resumes at it takes the same steps.
struct Pace {
  double step_s = 0.0;  ///< that comes next; 0: not known yet
  float log_of_last_error = 0.0F;
  long ticks = 0, cost = 0, stiff_from_tick = -1;  ///< of `automatic`; cost: since it last looked
};

class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// Carries `flow` from one instant to the next [s] with everything in `held` frozen, but for stick and
  /// slip, which is switched where it happens. Throws NumericalFailure; `flow` is then what was last reached.
  virtual void advance(Flow& flow, plant::Held& held, double from_s, double to_s) = 0;

  virtual Counters counters() const = 0;

  virtual Pace pace() const = 0;
  virtual void resume(const Pace& pace) = 0;
};

/// An integrator for a plant that outlives it. `keep_ledger`: carry the ledger along, at some cost.
std::unique_ptr<Integrator> make_integrator(const plant::Plant& rig, const Settings& settings,
                                            bool keep_ledger);

}  // namespace mckibben::engine
