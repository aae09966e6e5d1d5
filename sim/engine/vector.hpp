// A SUNDIALS vector of fixed length. The library's operations are loops over a run-time length, behind
// checks, and in Debian's build not even optimised; these are compiled with us, unrolled by Eigen, and need
// no allocation after setup.
#pragma once

#include <cmath>
#include <new>

#include <Eigen/Core>
#include <sundials/sundials_nvector.h>

namespace mckibben::engine {

/// The vector operations for N components, of which the first `Norm` make the error norm, their sum of
/// squares over `Counted`; the others are quadrature variables. One component of padding makes an odd N even,
/// so that all loads and stores are of pairs.
template <int N, int Norm, int Counted = Norm>
struct FixedVector {
  static constexpr int size = N;
  using Values = Eigen::Array<double, N + N % 2, 1>;

  static Values& values(N_Vector v) { return *static_cast<Values*>(v->content); }
  static double* data(N_Vector v) { return values(v).data(); }

  static N_Vector make(SUNContext context) {
    N_Vector v = N_VNewEmpty(context);
    if (v == nullptr) throw std::bad_alloc();
    v->content = new Values(Values::Zero());
    v->ops->nvgetvectorid = [](N_Vector) { return SUNDIALS_NVEC_CUSTOM; };
    v->ops->nvclone = [](N_Vector x) { return make(x->sunctx); };
    v->ops->nvdestroy = destroy;
    v->ops->nvgetlength = [](N_Vector) -> sunindextype { return N; };
    v->ops->nvlinearsum = linear_sum;
    v->ops->nvconst = [](double c, N_Vector z) { values(z).setConstant(c); };
    v->ops->nvprod = [](N_Vector x, N_Vector y, N_Vector z) { values(z) = values(x) * values(y); };
    v->ops->nvdiv = [](N_Vector x, N_Vector y, N_Vector z) { values(z) = values(x) / values(y); };
    v->ops->nvscale = [](double c, N_Vector x, N_Vector z) { values(z) = c * values(x); };
    v->ops->nvabs = [](N_Vector x, N_Vector z) { values(z) = values(x).abs(); };
    v->ops->nvinv = [](N_Vector x, N_Vector z) { values(z) = 1.0 / values(x); };
    v->ops->nvaddconst = [](N_Vector x, double b, N_Vector z) { values(z) = values(x) + b; };
    v->ops->nvmaxnorm = [](N_Vector x) { return values(x).template head<N>().abs().maxCoeff(); };
    v->ops->nvwrmsnorm = wrms_norm;
    v->ops->nvmin = [](N_Vector x) { return values(x).template head<N>().minCoeff(); };
    v->ops->nvlinearcombination = linear_combination;
    v->ops->nvscaleaddmulti = scale_add_multi;
    return v;
  }

 private:
  static void destroy(N_Vector v) {
    if (v == nullptr) return;
    delete static_cast<Values*>(v->content);
    v->content = nullptr;
    N_VFreeEmpty(v);
  }

  static void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
    values(z) = a * values(x) + b * values(y);
  }

  static double wrms_norm(N_Vector x, N_Vector w) {
    const double* a = data(x);
    const double* b = data(w);
    double sum = 0.0;
    for (int i = 0; i < Norm; ++i) sum += (a[i] * b[i]) * (a[i] * b[i]);
    return std::sqrt(sum / Counted);
  }

  static int linear_combination(int count, double* c, N_Vector* x, N_Vector z) {
    Values sum = c[0] * values(x[0]);
    for (int k = 1; k < count; ++k) sum += c[k] * values(x[k]);
    values(z) = sum;
    return 0;
  }

  static int scale_add_multi(int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) {
    for (int k = 0; k < count; ++k) linear_sum(a[k], x, 1.0, y[k], z[k]);
    return 0;
  }
};

}  // namespace mckibben::engine
