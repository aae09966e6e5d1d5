// ARKODE ERKStep, reset at each tick because the current jumps there (a step across the jump is accepted with
// a wrong answer). Step sizes are chosen here, by a PI rule (Gustafsson, ACM TOMS 17 (1991) 533-554), so that
// a tick is divided evenly: a last step cut short in every tick would make the first of the next one start
// small again.
#pragma once

#include <algorithm>
#include <cmath>

#include <arkode/arkode_erkstep.h>

#include <sim/engine/integrator.hpp>
#include <sim/engine/sundials.hpp>

namespace mckibben::engine {

Trouble erk_trouble(int flag);

/// V: kind of SUNDIALS vector, see sundials.hpp.
template <class V>
class Erk final : public Integrator {
 public:
  Erk(const plant::Plant& rig, double tolerance) : problem_(rig), y_(V::make(context_)) {
    memory_.reset(ERKStepCreate(forbidding_right_hand_side, 0.0, y_.get(), context_));
    if (!memory_) throw std::bad_alloc();
    void* m = memory_.get();
    ERKStepSetErrHandlerFn(m, keep_message, &message_);
    ERKStepSetUserData(m, &problem_);
    ERKStepSVtolerances(m, tolerance, absolute_tolerances<V>(context_, tolerance).get());
    ERKStepSetTableNum(m, ARKODE_CASH_KARP_6_4_5);
    ERKStepSetInterpolantDegree(m, 1);  // only asked for at the ends of steps, unless events are looked for
    ERKStepSetMaxErrTestFails(m, 50);   // the braid stop may need more than the library's 7
    ERKStepSetMaxNumSteps(m, most_steps_in_a_tick);
    ERKStepSetAdaptivityFn(m, choose_step, this);
    ERKStepSetSafetyFactor(m, 1.0);
    ERKStepSetErrorBias(m, 1.0);
    ERKStepSetFixedStepBounds(m, 1.0, 1.0);
    if (rig.has_events()) {
      int falling = -1;
      ERKStepSetInterpolantDegree(m, 3);
      ERKStepRootInit(m, 1, event_margin<V>);
      ERKStepSetRootDirection(m, &falling);
      ERKStepSetNoInactiveRootWarn(m);
    }
    before_ = warm_up(*this, rig);
  }

  void advance(Flow& flow, plant::Held& held, double from_s, double to_s) override {
    problem_.refused = 0;
    tick_s_ = to_s - from_s;
    stop_s_ = to_s;
    events_ += carry<V>(problem_, y_.get(), flow, held, from_s, to_s, "ERKStep", message_,
                        [&](double& t, Trouble& trouble) {
                          void* m = memory_.get();
                          message_.clear();
                          reached_s_ = t;
                          ERKStepReset(m, t, y_.get());
                          ERKStepSetStopTime(m, to_s);
                          const int flag = ERKStepEvolve(m, to_s, y_.get(), &t, ARK_NORMAL);
                          if (flag == ARK_ROOT_RETURN) return Reached::event;
                          if (flag >= 0) return Reached::end;
                          t = reached_s_;  // the library tells the time of the stage that failed
                          trouble = erk_trouble(flag);
                          return Reached::trouble;
                        });
  }

  Counters counters() const override { return all_counters() - before_; }

 private:
  Counters all_counters() const {
    long expansions = 0, accuracy = 0, attempts = 0, evaluations = 0, failures = 0;
    Counters c;
    ERKStepGetTimestepperStats(memory_.get(), &expansions, &accuracy, &attempts, &evaluations, &failures);
    ERKStepGetNumSteps(memory_.get(), &c.steps);
    c.rejected_steps = failures;
    c.right_hand_sides = evaluations;
    c.events = events_;
    return c;
  }

  struct Free {
    void operator()(void* memory) const { ERKStepFree(&memory); }
  };

  // ERKStep gives up at the first stage that a right-hand side refuses. Outside the domain of the laws it
  // gets rates that no step can pass its error test with, so that it tries a smaller one. They differ from
  // call to call: equal ones would cancel in the error estimate.
  static int forbidding_right_hand_side(double t, N_Vector y, N_Vector dydt, void* problem) {
    if (right_hand_side<V>(t, y, dydt, problem) == 0) return 0;
    auto& refused = static_cast<Problem<V::size>*>(problem)->refused;
    if (refused > most_refused_in_a_tick) return -1;
    const double rate_per_s = 1e9 * static_cast<double>(1 + refused++ % 7);
    std::fill_n(V::data(dydt), V::size, 0.0);
    for (std::size_t i = 0; i < working_size.size(); ++i) V::data(dydt)[i] = rate_per_s * working_size[i];
    return 0;
  }

  // Called with the local error (1 = tolerance) of a step of size h that ends, or if rejected begins, at t.
  static int choose_step(N_Vector, double t, double h, double, double, double error, double, double, int, int,
                         double* next, void* self) {
    auto& erk = *static_cast<Erk*>(self);
    const float now = std::log(static_cast<float>(std::max(error, 1e-10)));  // exact enough for a step size
    const bool accepted = error <= 1.0;
    const float change = std::exp(accepted ? -0.16F * now + 0.05F * erk.log_of_last_error_ : -0.2F * now);
    const double wanted = 0.9 * h * static_cast<double>(change);
    if (accepted) {
      erk.log_of_last_error_ = now;
      erk.reached_s_ = t;
    }
    const double left_s = erk.stop_s_ - t;
    const double span_s =
        left_s > 1e-9 * erk.tick_s_ ? left_s : erk.tick_s_;  // at the end: plan the next tick
    *next = span_s / std::ceil(span_s / wanted);
    return 0;
  }

  Context context_;
  Problem<V::size> problem_;
  std::string message_;
  Vector y_;
  std::unique_ptr<void, Free> memory_;
  double stop_s_ = 0.0, tick_s_ = 0.0, reached_s_ = 0.0;
  float log_of_last_error_ = 0.0F;
  long events_ = 0;
  Counters before_;
};

}  // namespace mckibben::engine
