// What both SUNDIALS methods share: ownership of the library's objects, the problem's callbacks, words for
// failures. Only this folder names SUNDIALS.
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include <sundials/sundials_context.h>
#include <sundials/sundials_types.h>

#include <sim/engine/failure.hpp>
#include <sim/engine/integrator.hpp>
#include <sim/engine/problem.hpp>
#include <sim/engine/vector.hpp>

namespace mckibben::engine {

/// The vectors that the methods work on. A kind of vector V offers layout, size, make(context), data(vector).
template <int sides, plant::Memories memories, Books books>
struct PlantVector
    : FixedVector<Layout<sides, memories, books>::size, Layout<sides, memories, books>::steering,
                  Layout<sides, memories, books>::counted> {
  using layout = Layout<sides, memories, books>;
};

/// make(V*) for the vector V that a rig needs.
auto with_vector(const plant::Plant& rig, bool keep_ledger, const auto& make) {
  using plant::Memories;
  const auto with = [&]<int sides, Memories memories, Books books> {
    return make(static_cast<PlantVector<sides, memories, books>*>(nullptr));
  };
  // With every ledger: these are few, and each kind of vector is compiled with each method.
  const bool all = rig.memories() == Memories::all;
  if (rig.opposite() && all) return with.template operator()<2, Memories::all, Books::polytropic>();
  if (rig.opposite()) return with.template operator()<2, Memories::few, Books::polytropic>();
  if (all) return with.template operator()<1, Memories::all, Books::polytropic>();
  const auto with_books = [&]<Memories memories> {
    if (!keep_ledger) return with.template operator()<1, memories, Books::none>();
    if (rig.polytropic()) return with.template operator()<1, memories, Books::polytropic>();
    return with.template operator()<1, memories, Books::isothermal>();
  };
  return rig.remembers() ? with_books.template operator()<Memories::few>()
                         : with_books.template operator()<Memories::none>();
}

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

/// Right-hand side callback; positive where the solver should try a smaller step.
template <class V>
int right_hand_side(double, N_Vector y, N_Vector dydt, void* problem) {
  return static_cast<Problem<typename V::layout>*>(problem)->rates(V::data(y), V::data(dydt)) ? 0 : 1;
}

/// Event callback of both methods (stick and slip).
template <class V>
int event_margin(double, N_Vector y, double* margin, void* problem) {
  const auto& p = *static_cast<Problem<typename V::layout>*>(problem);
  *margin = p.plant().event_margin(p.state_of(V::data(y)), p.memory_of(V::data(y)), p.held);
  return 0;
}

/// Absolute tolerances for a vector like `y`: the working sizes times the tolerance; quadrature variables get
/// a weight of no consequence.
template <class V>
Vector absolute_tolerances(N_Vector y, double tolerance) {
  using L = typename V::layout;
  Vector v(N_VClone(y));
  const sunindextype length = N_VGetLength(y), rigs = length / L::size;
  std::fill_n(V::data(v.get()), length, 1.0);
  for (int i = 0; i < L::steering; ++i)
    std::fill_n(V::data(v.get()) + rigs * i, rigs, tolerance * size_of<L>(i));
  return v;
}

/// Events closer together than this in one tick mean that the mode cannot settle.
inline constexpr int most_events_in_a_tick = 1000;

/// Steps a tick may take before it is called a failure.
inline constexpr long most_steps_in_a_tick = 20000;

/// Trial states outside the domain that a tick may meet.
inline constexpr long most_refused_in_a_tick = 2000;

/// Rates that no step can pass its error test with. They differ from call to call: equal ones would cancel in
/// the error estimate.
inline void forbid(double* dydt, long call) {
  const double rate_per_s = 1e9 * static_cast<double>(1 + call % 7);
  for (std::size_t i = 0; i < std::size_t{plant::single_size}; ++i) dydt[i] = rate_per_s * working_size[i];
}

enum class Trouble { too_many_steps, too_accurate, error_test, outside_domain, convergence, events, other };
/// Of a return value of ERKStep.
Trouble erk_trouble(int flag);
/// What went wrong, its likely cause and what may help. Near the edge of the domain that is the likelier
/// cause of a solver's trouble with its steps.
std::string cause_of(Trouble trouble, const char* solver, const std::string& message, const plant::Plant& rig,
                     const plant::State<double>& state);

/// Keeps the library's own words instead of letting it print them.
void keep_message(int code, const char* module, const char* function, char* message, void* text);

/// The libraries allocate the last of their memory in their first step: it is done here, from rest. Returns
/// what it cost, which is not the run's; nor is a failure.
inline Counters warm_up(Integrator& integrator, const plant::Plant& rig) {
  Flow scratch{rig.at_rest({}), {}, rig.opened(rig.at_rest({}))};
  plant::Held held;
  try {
    integrator.advance(scratch, held, 0.0, 1e-9);
  } catch (const NumericalFailure&) {  // what troubles this rig, the run will tell
  }
  return integrator.counters();
}

/// How far a solver came: to the end of the tick, to an event on the way, or not.
enum class Reached { end, event, trouble };

/// Carries flow and held through a tick, switching stick and slip where `evolve(t, trouble)` stops at an
/// event. `evolve` starts from y at t, moves both on to what it reached, and says what that is and what
/// troubled it. Returns the number of events. Throws NumericalFailure; `flow` is then what was last reached.
template <class V, class Evolve>
long carry(Problem<typename V::layout>& problem, N_Vector y, Flow& flow, plant::Held& held, double from_s,
           double to_s, const char* solver, const std::string& message, const Evolve& evolve) {
  problem.held = held;
  double t = from_s;
  for (long events = 0;; ++events) {
    problem.store(flow, V::data(y));
    Trouble trouble = Trouble::outside_domain;
    Reached reached =
        problem.plant().in_domain(flow.state, flow.memory) ? evolve(t, trouble) : Reached::trouble;
    problem.load(V::data(y), flow);
    if (reached == Reached::event && events == most_events_in_a_tick) {
      reached = Reached::trouble;
      trouble = Trouble::events;
    }
    if (reached == Reached::trouble)
      throw NumericalFailure(t, flow.state, cause_of(trouble, solver, message, problem.plant(), flow.state));
    if (reached == Reached::event) {
      held.slip = problem.held.slip = problem.plant().slip_from_rest(flow.state, flow.memory, held);
      if (t < to_s) continue;
    }
    if (problem.plant().has_events() && held.slip == plant::Slip::sticking)
      flow.state.joint.contraction_speed_per_s = 0.0;  // to the last bit: Newton's solution is rounded
    return events + (reached == Reached::event ? 1 : 0);
  }
}

}  // namespace mckibben::engine
