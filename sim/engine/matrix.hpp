// Matrix and direct linear solver for CVODE's Newton iteration:
// fixed size, in Eigen, no allocation after setup.
#pragma once

#include <new>

#include <Eigen/LU>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

namespace mckibben::engine {

template <int N>
using Square = Eigen::Matrix<double, N, N>;

template <int N>
Square<N>& values(SUNMatrix m) {
  return *static_cast<Square<N>*>(m->content);
}

template <int N>
SUNMatrix make_matrix(SUNContext context) {
  SUNMatrix m = SUNMatNewEmpty(context);
  if (m == nullptr) throw std::bad_alloc();
  m->content = new Square<N>(Square<N>::Zero());
  m->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  m->ops->clone = [](SUNMatrix a) { return make_matrix<N>(a->sunctx); };
  m->ops->destroy = [](SUNMatrix a) {
    delete static_cast<Square<N>*>(a->content);
    a->content = nullptr;
    SUNMatFreeEmpty(a);
  };
  m->ops->zero = [](SUNMatrix a) {
    values<N>(a).setZero();
    return 0;
  };
  m->ops->copy = [](SUNMatrix a, SUNMatrix b) {
    values<N>(b) = values<N>(a);
    return 0;
  };
  m->ops->scaleaddi = [](double c, SUNMatrix a) {  // A = c A + I
    values<N>(a) = c * values<N>(a) + Square<N>::Identity();
    return 0;
  };
  return m;
}

template <class V>
SUNLinearSolver make_linear_solver(SUNContext context) {
  constexpr int N = V::size;
  using Lu = Eigen::PartialPivLU<Square<N>>;
  SUNLinearSolver s = SUNLinSolNewEmpty(context);
  if (s == nullptr) throw std::bad_alloc();
  s->content = new Lu();
  s->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  s->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  s->ops->initialize = [](SUNLinearSolver) { return 0; };
  s->ops->setup = [](SUNLinearSolver solver, SUNMatrix a) {
    static_cast<Lu*>(solver->content)->compute(values<N>(a));
    return 0;
  };
  s->ops->solve = [](SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, double) {
    using Column = Eigen::Matrix<double, N, 1>;
    const Eigen::Map<const Column> right(V::data(b));
    Eigen::Map<Column>(V::data(x)) = Column(static_cast<Lu*>(solver->content)->solve(right));
    return 0;
  };
  s->ops->free = [](SUNLinearSolver solver) {
    delete static_cast<Lu*>(solver->content);
    solver->content = nullptr;
    SUNLinSolFreeEmpty(solver);
    return 0;
  };
  return s;
}

}  // namespace mckibben::engine
