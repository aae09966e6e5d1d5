// Which method carries a rig. `automatic` starts explicit and watches the steps: once ticks cost several
// times what a rig of ordinary stiffness costs, BDF is cheaper and takes over for good.
#include <utility>

#include <sim/engine/cvode.hpp>
#include <sim/engine/erk.hpp>
#include <sim/engine/failure.hpp>
#include <sim/engine/integrator.hpp>

namespace mckibben::engine {
namespace {

class Automatic final : public Integrator {
 public:
  Automatic(const plant::Plant& rig, double tolerance, bool keep_ledger)
      : erk_(make_erk(rig, tolerance, keep_ledger)), cvode_(make_cvode(rig, tolerance, keep_ledger)) {}

  void advance(Flow& flow, plant::Held& held, double from_s, double to_s) override {
    const bool stiff = stiff_from_tick_ >= 0;
    const auto [flow_before, held_before] = std::pair{flow, held};
    try {
      (stiff ? cvode_ : erk_)->advance(flow, held, from_s, to_s);
    } catch (const NumericalFailure& failure) {  // the other may still manage
      flow = flow_before;
      held = held_before;
      try {
        (stiff ? erk_ : cvode_)->advance(flow, held, from_s, to_s);
      } catch (const NumericalFailure& second) {
        throw NumericalFailure(second.time_s, second.state, second.cause + "; before it, " + failure.cause);
      }
      if (!stiff) stiff_from_tick_ = ticks_;
      return;
    }
    if (stiff) return;
    if (++ticks_ % window_ticks != 0) return;
    const long cost = erk_->counters().right_hand_sides;
    if (cost - cost_before_ > stiff_cost_per_tick * window_ticks) stiff_from_tick_ = ticks_;
    cost_before_ = cost;
  }

  Counters counters() const override {
    Counters sum = erk_->counters() + cvode_->counters();
    sum.stiff_from_tick = stiff_from_tick_;
    return sum;
  }

  Pace pace() const override {
    Pace pace = erk_->pace();
    pace.ticks = ticks_;
    pace.cost = erk_->counters().right_hand_sides - cost_before_;
    pace.stiff_from_tick = stiff_from_tick_;
    return pace;
  }
  void resume(const Pace& pace) override {
    erk_->resume(pace);
    ticks_ = pace.ticks;
    cost_before_ = erk_->counters().right_hand_sides - pace.cost;
    stiff_from_tick_ = pace.stiff_from_tick;
  }

 private:
  std::unique_ptr<Integrator> erk_, cvode_;
  long ticks_ = 0, cost_before_ = 0, stiff_from_tick_ = -1;
};

}  // namespace

Counters operator-(const Counters& later, const Counters& earlier) {
  Counters difference = later;
  difference.steps -= earlier.steps;
  difference.rejected_steps -= earlier.rejected_steps;
  difference.right_hand_sides -= earlier.right_hand_sides;
  difference.jacobians -= earlier.jacobians;
  difference.events -= earlier.events;
  return difference;
}

Counters operator+(const Counters& earlier, const Counters& later) {
  Counters sum = later;
  sum.steps += earlier.steps;
  sum.rejected_steps += earlier.rejected_steps;
  sum.right_hand_sides += earlier.right_hand_sides;
  sum.jacobians += earlier.jacobians;
  sum.events += earlier.events;
  return sum;
}

std::unique_ptr<Integrator> make_integrator(const plant::Plant& rig, const Settings& settings,
                                            bool keep_ledger) {
  switch (settings.method) {
    case Method::erk:
      return make_erk(rig, settings.tolerance, keep_ledger);
    case Method::cvode:
      return make_cvode(rig, settings.tolerance, keep_ledger);
    case Method::automatic:
      break;
  }
  return std::make_unique<Automatic>(rig, settings.tolerance, keep_ledger);
}

}  // namespace mckibben::engine
