// ARKODE ERKStep, reset at each tick because the current jumps there (a step across the jump is accepted with
// a wrong answer).
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include <arkode/arkode_erkstep.h>

#include <sim/engine/even_steps.hpp>
#include <sim/engine/integrator.hpp>
#include <sim/engine/sundials.hpp>

namespace mckibben::engine {

struct FreeErk {
  void operator()(void* memory) const { ERKStepFree(&memory); }
};
using ErkMemory = std::unique_ptr<void, FreeErk>;

/// What every ERKStep of ours is set to, but for the choice of its steps: Cash-Karp. V: kind of its vector.
template <class V>
void set_up_erk(void* m, N_Vector y, double tolerance, void* user, std::string& message) {
  ERKStepSetErrHandlerFn(m, keep_message, &message);
  ERKStepSetUserData(m, user);
  ERKStepSVtolerances(m, tolerance, absolute_tolerances<V>(y, tolerance).get());
  ERKStepSetTableNum(m, ARKODE_CASH_KARP_6_4_5);
  ERKStepSetInterpolantDegree(m, 1);  // only asked for at the ends of steps, unless events are looked for
  ERKStepSetMaxErrTestFails(m, 50);   // the braid stop may need more than the library's 7
  ERKStepSetMaxNumSteps(m, most_steps_in_a_tick);
  // The library takes 0.99 of each step that it is told: a tick ends in a few tiny ones. Without them errors
  // in e are up to three times as large, and the fits of `diagnose` notice.
  ERKStepSetErrorBias(m, 1.0);
  ERKStepSetFixedStepBounds(m, 1.0, 1.0);
}

/// V: kind of SUNDIALS vector, see sundials.hpp.
template <class V>
class Erk final : public Integrator {
 public:
  Erk(const plant::Plant& rig, double tolerance) : problem_(rig), y_(V::make(context_)) {
    memory_.reset(ERKStepCreate(forbidding_right_hand_side, 0.0, y_.get(), context_));
    if (!memory_) throw std::bad_alloc();
    void* m = memory_.get();
    set_up_erk<V>(m, y_.get(), tolerance, &problem_, message_);
    ERKStepSetAdaptivityFn(m, EvenSteps::choose, &steps_);
    if (rig.has_events()) {
      int falling = -1;
      ERKStepSetInterpolantDegree(m, 5);  // the state at an event as exact as at the end of a step
      ERKStepRootInit(m, 1, event_margin<V>);
      ERKStepSetRootDirection(m, &falling);
      ERKStepSetNoInactiveRootWarn(m);
    }
    before_ = warm_up(*this, rig);
  }

  void advance(Flow& flow, plant::Held& held, double from_s, double to_s) override {
    problem_.refused = 0;
    steps_.begin(from_s, to_s);
    events_ += carry<V>(problem_, y_.get(), flow, held, from_s, to_s, "ERKStep", message_,
                        [&](double& t, Trouble& trouble) {
                          void* m = memory_.get();
                          message_.clear();
                          steps_.reached_s = t;
                          ERKStepReset(m, t, y_.get());
                          ERKStepSetStopTime(m, to_s);
                          const int flag = ERKStepEvolve(m, to_s, y_.get(), &t, ARK_NORMAL);
                          if (flag == ARK_ROOT_RETURN) return Reached::event;
                          if (flag >= 0) return Reached::end;
                          t = steps_.reached_s;  // the library tells the time of the stage that failed
                          trouble = erk_trouble(flag);
                          return Reached::trouble;
                        });
  }

  Counters counters() const override { return all_counters() - before_; }
  Pace pace() const override {
    Pace pace{.log_of_last_error = steps_.log_of_last_error};
    if (steps_.resumed_step_s)  // of which the library says nothing yet
      pace.step_s = *steps_.resumed_step_s;
    else
      ERKStepGetCurrentStep(memory_.get(), &pace.step_s);
    return pace;
  }
  void resume(const Pace& pace) override {
    steps_.log_of_last_error = pace.log_of_last_error;
    steps_.resumed_step_s = pace.step_s;
    ERKStepSetInitStep(memory_.get(), pace.step_s);
  }

 private:
  Counters all_counters() const {
    long expansions = 0, accuracy = 0, attempts = 0;
    Counters c{.events = events_};
    ERKStepGetTimestepperStats(memory_.get(), &expansions, &accuracy, &attempts, &c.right_hand_sides,
                               &c.rejected_steps);
    ERKStepGetNumSteps(memory_.get(), &c.steps);
    return c;
  }

  // ERKStep gives up at the first stage that a right-hand side refuses. Outside the domain of the laws it
  // gets rates that no step can pass its error test with, so that it tries a smaller one.
  static int forbidding_right_hand_side(double t, N_Vector y, N_Vector dydt, void* problem) {
    if (right_hand_side<V>(t, y, dydt, problem) == 0) return 0;
    auto& refused = static_cast<Problem<typename V::layout>*>(problem)->refused;
    if (refused > most_refused_in_a_tick) return -1;
    std::fill_n(V::data(dydt), V::size, 0.0);
    forbid(V::data(dydt), refused++);
    return 0;
  }

  Context context_;
  Problem<typename V::layout> problem_;
  std::string message_;
  Vector y_;
  ErkMemory memory_;
  EvenSteps steps_;
  long events_ = 0;
  Counters before_;
};

}  // namespace mckibben::engine
