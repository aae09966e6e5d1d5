// Version and build of the library at run time.
#include <algorithm>
#include <chrono>
#include <limits>

#include <dlfcn.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_version.h>

#include <sim/engine/sundials.hpp>
#include <sim/engine/versions.hpp>

namespace mckibben::engine {
namespace {

/// The shortest of some tries: what else the machine does can only add.
template <class Work>
double seconds_of(const Work& work) {
  double least_s = std::numeric_limits<double>::max();
  for (int i = 0; i < 200; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    least_s = std::min(least_s, taken.count());
  }
  return least_s;
}

/// The library's loop as this program's compiler makes it.
[[gnu::noinline]] void sum(int n, double a, const double* x, double b, const double* y, double* z) {
  for (int i = 0; i < n; ++i) z[i] = a * x[i] + b * y[i];
}

double slowness() {
  const Context context;
  constexpr int n = 512;  // all three fit the nearest cache
  const Vector x(N_VNew_Serial(n, context)), y(N_VNew_Serial(n, context)), z(N_VNew_Serial(n, context));
  N_VConst(1.0, x.get());
  N_VConst(2.0, y.get());
  const double there_s = seconds_of([&] { N_VLinearSum_Serial(2.0, x.get(), 3.0, y.get(), z.get()); });
  const double here_s =
      seconds_of([&] { sum(n, 2.0, NV_DATA_S(x.get()), 3.0, NV_DATA_S(y.get()), NV_DATA_S(z.get())); });
  return there_s / here_s;
}

}  // namespace

std::string sundials_version() {
  char text[64] = "";
  SUNDIALSGetVersion(text, sizeof text);
  return text;
}

SundialsBuild sundials_build() {
  SundialsBuild build;
  build.version = sundials_version();
  build.headers_version = SUNDIALS_VERSION;
  Dl_info where{};
  if (dladdr(reinterpret_cast<void*>(&N_VLinearSum_Serial), &where) != 0 && where.dli_fname != nullptr)
    build.file = where.dli_fname;
  build.precision = sizeof(realtype) == sizeof(float)    ? "single"
                    : sizeof(realtype) == sizeof(double) ? "double"
                                                         : "extended";
  build.index_bits = static_cast<int>(8 * sizeof(sunindextype));
#ifdef SUNDIALS_LOGGING_LEVEL
  build.logging_level = SUNDIALS_LOGGING_LEVEL;
#endif
#ifdef SUNDIALS_BUILD_WITH_PROFILING
  build.profiling = true;
#endif
#ifdef SUNDIALS_BUILD_WITH_MONITORING
  build.monitoring = true;
#endif
#ifdef SUNDIALS_MPI_ENABLED
  build.mpi = SUNDIALS_MPI_ENABLED != 0;
#endif
  build.slowness = slowness();
  return build;
}

}  // namespace mckibben::engine
