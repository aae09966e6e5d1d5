// A SUNDIALS vector of the states of eight rigs, component by component: its operations work on all of them
// at once, with what vector registers the machine has.
#pragma once

#include <array>
#include <cmath>
#include <new>

#include <sundials/sundials_nvector.h>

#include <sim/engine/lanes.hpp>

namespace mckibben::engine {

/// N components. The error norm is that of the rig that is worst off.
template <int N>
struct LaneVector {
  static constexpr int lanes = static_cast<int>(Lanes::count), size = N * lanes;
  using Values = std::array<Lanes, N>;

  static Values& values(N_Vector v) { return *static_cast<Values*>(v->content); }
  static double* data(N_Vector v) { return reinterpret_cast<double*>(values(v).data()); }

  static N_Vector make(SUNContext context) {
    N_Vector v = N_VNewEmpty(context);
    if (v == nullptr) throw std::bad_alloc();
    auto* content = new Values;
    content->fill(Lanes(0.0));
    v->content = content;
    v->ops->nvgetvectorid = [](N_Vector) { return SUNDIALS_NVEC_CUSTOM; };
    v->ops->nvclone = [](N_Vector x) { return make(x->sunctx); };
    v->ops->nvdestroy = destroy;
    v->ops->nvgetlength = [](N_Vector) -> sunindextype { return size; };
    v->ops->nvlinearsum = [](double a, N_Vector x, double b, N_Vector y, N_Vector z) {
      each(z, [&, &p = values(x), &q = values(y)](std::size_t i) { return a * p[i] + b * q[i]; });
    };
    v->ops->nvconst = [](double c, N_Vector z) { values(z).fill(Lanes(c)); };
    v->ops->nvprod = [](N_Vector x, N_Vector y, N_Vector z) {
      each(z, [&p = values(x), &q = values(y)](std::size_t i) { return p[i] * q[i]; });
    };
    v->ops->nvdiv = [](N_Vector x, N_Vector y, N_Vector z) {
      each(z, [&p = values(x), &q = values(y)](std::size_t i) { return p[i] / q[i]; });
    };
    v->ops->nvscale = [](double c, N_Vector x, N_Vector z) {
      each(z, [&, &p = values(x)](std::size_t i) { return c * p[i]; });
    };
    v->ops->nvabs = [](N_Vector x, N_Vector z) {
      each(z, [&p = values(x)](std::size_t i) { return abs(p[i]); });
    };
    v->ops->nvinv = [](N_Vector x, N_Vector z) {
      each(z, [&p = values(x)](std::size_t i) { return 1.0 / p[i]; });
    };
    v->ops->nvaddconst = [](N_Vector x, double b, N_Vector z) {
      each(z, [&, &p = values(x)](std::size_t i) { return p[i] + b; });
    };
    v->ops->nvmaxnorm = [](N_Vector x) {
      double most = 0.0;
      for (int i = 0; i < size; ++i) most = std::max(most, std::abs(data(x)[i]));
      return most;
    };
    v->ops->nvmin = [](N_Vector x) { return *std::min_element(data(x), data(x) + size); };
    v->ops->nvwrmsnorm = wrms_norm;
    v->ops->nvlinearcombination = [](int count, double* c, N_Vector* x, N_Vector z) {
      each(z, [&](std::size_t i) {
        Lanes sum = c[0] * values(x[0])[i];
        for (int k = 1; k < count; ++k) sum = sum + c[k] * values(x[k])[i];
        return sum;
      });
      return 0;
    };
    v->ops->nvscaleaddmulti = [](int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) {
      for (int k = 0; k < count; ++k)
        each(z[k], [&, &p = values(x), &q = values(y[k])](std::size_t i) { return a[k] * p[i] + q[i]; });
      return 0;
    };
    return v;
  }

 private:
  static void destroy(N_Vector v) {
    if (v == nullptr) return;
    delete static_cast<Values*>(v->content);
    v->content = nullptr;
    N_VFreeEmpty(v);
  }

  template <class F>
  static void each(N_Vector z, const F& f) {
    on_this_machine([&, &to = values(z)] {
      for (std::size_t i = 0; i < N; ++i) to[i] = f(i);
    });
  }

  static double wrms_norm(N_Vector x, N_Vector w) {
    Lanes sum = 0.0;
    on_this_machine([&, &p = values(x), &q = values(w)] {
      for (std::size_t i = 0; i < N; ++i) {
        const Lanes term = p[i] * q[i];
        sum = sum + term * term;
      }
    });
    double largest = 0.0;
    for (std::size_t lane = 0; lane < Lanes::count; ++lane)
      if (!(sum[lane] <= largest)) largest = sum[lane];  // also where it is not a number
    return std::sqrt(largest / N);
  }
};

}  // namespace mckibben::engine
