// A SUNDIALS vector of the states of many rigs, component by component, each in blocks of eight rigs: its
// operations work on all of them at once, with what vector registers the machine has.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <vector>

#include <sundials/sundials_nvector.h>

#include <sim/engine/lanes.hpp>

namespace mckibben::engine {

/// N components, of which the first `Norm` make the error norm, their sum of squares over `Counted`; the
/// others are quadrature variables. The norm is that of each rig; the library sees one that always passes.
template <int N, int Norm, int Counted = Norm>
struct LaneVector {
  /// Component i of block b stands at i * blocks + b.
  using Values = std::vector<Lanes>;

  static Values& values(N_Vector v) { return content(v).values; }
  static double* data(N_Vector v) { return reinterpret_cast<double*>(values(v).data()); }

  /// `norms`: where those of each rig go, block by block.
  static N_Vector make(SUNContext context, std::size_t blocks, Values& norms) {
    N_Vector v = N_VNewEmpty(context);
    if (v == nullptr) throw std::bad_alloc();
    v->content = new Content{Values(blocks * N, Lanes(0.0)), norms};
    v->ops->nvgetvectorid = [](N_Vector) { return SUNDIALS_NVEC_CUSTOM; };
    v->ops->nvclone = [](N_Vector x) { return make(x->sunctx, values(x).size() / N, content(x).norms); };
    v->ops->nvdestroy = destroy;
    v->ops->nvgetlength = [](N_Vector x) { return static_cast<sunindextype>(length(x)); };
    v->ops->nvlinearsum = [](double a, N_Vector x, double b, N_Vector y, N_Vector z) {
      each(z, [&, &p = values(x), &q = values(y)](std::size_t i) { return a * p[i] + b * q[i]; });
    };
    v->ops->nvconst = [](double c, N_Vector z) { std::fill(values(z).begin(), values(z).end(), Lanes(c)); };
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
      for (std::size_t i = 0; i < length(x); ++i) most = std::max(most, std::abs(data(x)[i]));
      return most;
    };
    v->ops->nvmin = [](N_Vector x) { return *std::min_element(data(x), data(x) + length(x)); };
    v->ops->nvwrmsnorm = wrms_norm;
    v->ops->nvlinearcombination = [](int count, double* c, N_Vector* x, N_Vector z) {
      return combine<most_terms>(static_cast<std::size_t>(count), c, x, z) ? 0 : -1;
    };
    v->ops->nvscaleaddmulti = [](int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) {
      for (int k = 0; k < count; ++k)
        each(z[k], [&, &p = values(x), &q = values(y[k])](std::size_t i) { return a[k] * p[i] + q[i]; });
      return 0;
    };
    return v;
  }

 private:
  struct Content {
    Values values;
    Values& norms;
  };
  static Content& content(N_Vector v) { return *static_cast<Content*>(v->content); }
  static std::size_t length(N_Vector v) { return values(v).size() * Lanes::count; }

  static void destroy(N_Vector v) {
    if (v == nullptr) return;
    delete static_cast<Content*>(v->content);
    v->content = nullptr;
    N_VFreeEmpty(v);
  }

  template <class F>
  static void each(N_Vector z, const F& f) {
    on_this_machine([&, &to = values(z)] {
      for (std::size_t i = 0; i < to.size(); ++i) to[i] = f(i);
    });
  }

  static constexpr std::size_t most_terms = 8;  // ERKStep has the state and as many as stages

  /// Their number is known to the compiler: it keeps the factors in registers. False if there are more.
  template <std::size_t Terms>
  static bool combine(std::size_t count, const double* c, N_Vector* x, N_Vector z) {
    if (count > Terms) return false;
    if constexpr (Terms > 1)
      if (count < Terms) return combine<Terms - 1>(count, c, x, z);
    std::array<const Lanes*, Terms> from;
    for (std::size_t k = 0; k < Terms; ++k) from[k] = values(x[k]).data();
    std::array<double, Terms> by;
    std::copy_n(c, Terms, by.begin());
    each(z, [=](std::size_t i) {
      Lanes sum = by[0] * from[0][i];
      for (std::size_t k = 1; k < Terms; ++k) sum = sum + by[k] * from[k][i];
      return sum;
    });
    return true;
  }

  static double wrms_norm(N_Vector x, N_Vector w) {
    constexpr double passes = 0.5;
    const std::size_t blocks = values(x).size() / N;
    on_this_machine([&, &p = values(x), &q = values(w), &norms = content(x).norms] {
      for (std::size_t b = 0; b < blocks; ++b) {
        Lanes sum = 0.0;
        for (std::size_t i = b; i < Norm * blocks; i += blocks) {
          const Lanes term = p[i] * q[i];
          sum = sum + term * term;
        }
        norms[b] = sqrt(sum / Lanes(Counted));
      }
    });
    return passes;
  }
};

}  // namespace mckibben::engine
