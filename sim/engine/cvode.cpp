// CVODE BDF with our fixed-size vectors, matrix and solver, and the exact Jacobian; started anew at each
// tick, because a multistep method must not look back across the jump of the current.
#include <algorithm>

#include <cvode/cvode.h>

#include <sim/engine/cvode.hpp>
#include <sim/engine/jacobian.hpp>
#include <sim/engine/matrix.hpp>
#include <sim/engine/sundials.hpp>

namespace mckibben::engine {
namespace {

Trouble trouble_of(int flag) {
  switch (flag) {
    case CV_TOO_MUCH_WORK:
      return Trouble::too_many_steps;
    case CV_TOO_MUCH_ACC:
      return Trouble::too_accurate;
    case CV_ERR_FAILURE:
      return Trouble::error_test;
    case CV_CONV_FAILURE:
    case CV_LSETUP_FAIL:
    case CV_LSOLVE_FAIL:
      return Trouble::convergence;
    case CV_RHSFUNC_FAIL:
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR:
      return Trouble::outside_domain;
    default:
      return Trouble::other;
  }
}

struct MatrixDeleter {
  void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
};
struct SolverDeleter {
  void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
};

template <class V>
class Cvode final : public Integrator {
 public:
  Cvode(const plant::Plant& rig, double tolerance)
      : problem_(rig),
        y_(V::make(context_)),
        matrix_(make_matrix<V::size>(context_)),
        solver_(make_linear_solver<V>(context_)) {
    memory_.reset(CVodeCreate(CV_BDF, context_));
    if (!memory_) throw std::bad_alloc();
    void* m = memory_.get();
    problem_.store(Flow{rig.at_rest({}), {}, {}}, V::data(y_.get()));
    CVodeInit(m, right_hand_side<V>, 0.0, y_.get());
    CVodeSetErrHandlerFn(m, keep_message, &message_);
    CVodeSetUserData(m, &problem_);
    CVodeSVtolerances(m, tolerance, absolute_tolerances<V>(y_.get(), tolerance).get());
    CVodeSetLinearSolver(m, solver_.get(), matrix_.get());
    CVodeSetJacFn(m, exact_jacobian);
    CVodeSetMaxErrTestFails(m, 50);
    CVodeSetMaxNumSteps(m, most_steps_in_a_tick);
    if (rig.has_events()) {
      int falling = -1;
      CVodeRootInit(m, 1, event_margin<V>);
      CVodeSetRootDirection(m, &falling);
      CVodeSetNoInactiveRootWarn(m);
    }
    before_ = warm_up(*this, rig);
  }

  void advance(Flow& flow, plant::Held& held, double from_s, double to_s) override {
    finished_.events += carry<V>(problem_, y_.get(), flow, held, from_s, to_s, "CVODE", message_,
                                 [&](double& t, Trouble& trouble) {
                                   void* m = memory_.get();
                                   message_.clear();
                                   finished_ = plus_current(finished_);  // the library's counters start again
                                   CVodeReInit(m, t, y_.get());
                                   CVodeSetStopTime(m, to_s);
                                   const int flag = CVode(m, to_s, y_.get(), &t, CV_NORMAL);
                                   if (flag == CV_ROOT_RETURN) return Reached::event;
                                   if (flag >= 0) return Reached::end;
                                   trouble = trouble_of(flag);
                                   return Reached::trouble;
                                 });
  }

  Counters counters() const override { return plus_current(finished_) - before_; }
  Pace pace() const override { return {}; }  // each tick is a start of its own
  void resume(const Pace&) override {}

 private:
  struct Free {
    void operator()(void* memory) const { CVodeFree(&memory); }
  };

  static int exact_jacobian(double, N_Vector y, N_Vector, SUNMatrix j, void* problem, N_Vector, N_Vector,
                            N_Vector) {
    return jacobian(*static_cast<const Problem<typename V::layout>*>(problem), V::data(y), values<V::size>(j))
               ? 0
               : 1;
  }

  Counters plus_current(Counters c) const {
    long steps = 0, evaluations = 0, failures = 0, jacobians = 0;
    CVodeGetNumSteps(memory_.get(), &steps);
    CVodeGetNumRhsEvals(memory_.get(), &evaluations);
    CVodeGetNumErrTestFails(memory_.get(), &failures);
    CVodeGetNumJacEvals(memory_.get(), &jacobians);
    c.steps += steps;
    c.right_hand_sides += evaluations;
    c.rejected_steps += failures;
    c.jacobians += jacobians;
    return c;
  }

  Context context_;
  Problem<typename V::layout> problem_;
  std::string message_;
  Vector y_;
  std::unique_ptr<std::remove_pointer_t<SUNMatrix>, MatrixDeleter> matrix_;
  std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, SolverDeleter> solver_;
  std::unique_ptr<void, Free> memory_;
  Counters finished_, before_;
};

}  // namespace

std::unique_ptr<Integrator> make_cvode(const plant::Plant& rig, double tolerance, bool keep_ledger) {
  // BDF adds up more local errors than ERKStep: measured, this factor lets the ledger close as well.
  tolerance = std::max(3e-4 * tolerance, 1e-13);
  return with_vector(rig, keep_ledger, [&]<class V>(V*) -> std::unique_ptr<Integrator> {
    return std::make_unique<Cvode<V>>(rig, tolerance);
  });
}

}  // namespace mckibben::engine
