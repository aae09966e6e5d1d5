// What both SUNDIALS methods share: ownership of the library's objects, the problem's callbacks, words for
// failures. Only this folder names SUNDIALS.
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include <sundials/sundials_context.h>
#include <sundials/sundials_types.h>

#include <sim/engine/failure.hpp>
#include <sim/engine/problem.hpp>
#include <sim/engine/vector.hpp>

namespace mckibben::engine {

/// The vectors that the methods work on. A kind of vector V offers size, make(context) and data(vector).
using StateVector = FixedVector<plant::state_size, plant::state_size>;
using AuditedVector = FixedVector<plant::state_size + plant::ledger_size, plant::state_size>;

/// A SUNDIALS context: one for each integrator, since it is not shared between threads.
class Context {
 public:
  Context() {
    if (SUNContext_Create(nullptr, &context_) != 0) throw std::bad_alloc();
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { SUNContext_Free(&context_); }
  operator SUNContext() const { return context_; }

 private:
  SUNContext context_ = nullptr;
};

struct VectorDeleter {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, VectorDeleter>;

/// Right-hand side callback of both methods; positive where the solver should try a smaller step.
template <class V>
[[gnu::flatten]] int right_hand_side(double, N_Vector y, N_Vector dydt, void* problem) {
  return static_cast<Problem<V::size>*>(problem)->rates(V::data(y), V::data(dydt)) ? 0 : 1;
}

/// Event callback of both methods (stick and slip).
template <class V>
int event_margin(double, N_Vector y, double* margin, void* problem) {
  const auto& p = *static_cast<Problem<V::size>*>(problem);
  *margin = p.plant().event_margin(p.state_of(V::data(y)), p.held);
  return 0;
}

/// Absolute tolerances: the working sizes times the tolerance; passengers get a weight of no consequence.
template <class V>
Vector absolute_tolerances(SUNContext context, double tolerance) {
  Vector v(V::make(context));
  std::fill_n(V::data(v.get()), V::size, 1.0);
  for (std::size_t i = 0; i < working_size.size(); ++i) V::data(v.get())[i] = tolerance * working_size[i];
  return v;
}

/// Events closer together than this in one tick mean that the mode cannot settle.
inline constexpr int most_events_in_a_tick = 1000;

/// Steps a tick may take before it is called a failure.
inline constexpr long most_steps_in_a_tick = 200000;

enum class Trouble { too_many_steps, too_accurate, error_test, outside_domain, convergence, events, other };
std::string cause_of(Trouble trouble, const char* solver, const std::string& message);

/// Keeps the library's own words instead of letting it print them.
void keep_message(int code, const char* module, const char* function, char* message, void* text);

/// Leaves in `flow` what was last reached, and throws.
template <class V>
[[noreturn]] void fail(N_Vector y, Flow& flow, double time_s, const std::string& cause) {
  Problem<V::size>::load(V::data(y), flow);
  throw NumericalFailure(time_s, flow.state, cause);
}

/// Carries flow and held through a tick, switching stick and slip where `evolve(t)` stops at an event.
/// `evolve` starts from y at t, moves both on, and says whether it met an event before the end of the tick;
/// it throws on failure. Returns the number of events.
template <class V, class Evolve>
long carry(Problem<V::size>& problem, N_Vector y, Flow& flow, plant::Held& held, double from_s, double to_s,
           const char* solver, const Evolve& evolve) {
  problem.held = held;
  double t = from_s;
  for (long events = 0;; ++events) {
    problem.store(flow, V::data(y));
    const bool event = evolve(t);
    problem.load(V::data(y), flow);
    if (event) {
      if (events == most_events_in_a_tick)
        throw NumericalFailure(t, flow.state, cause_of(Trouble::events, solver, ""));
      held.slip = problem.held.slip = problem.plant().slip_from_rest(flow.state, held);
      if (t < to_s) continue;
    }
    if (problem.plant().has_events() && held.slip == plant::Slip::sticking)
      flow.state.joint.contraction_speed_per_s = 0.0;  // to the last bit: Newton's solution is rounded
    return events + (event ? 1 : 0);
  }
}

}  // namespace mckibben::engine
