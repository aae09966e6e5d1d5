// Which SUNDIALS library is linked, and how it was built.
#pragma once

#include <string>

namespace mckibben::engine {

/// Version of the SUNDIALS library, e.g. "6.4.1".
std::string sundials_version();

/// What the library's headers, its file and a loop of it tell.
struct SundialsBuild {
  std::string version;          ///< of the library that runs
  std::string headers_version;  ///< of the headers that this program was compiled with
  std::string file;             ///< where the library was loaded from; empty if linked statically
  std::string precision;        ///< of its numbers
  int index_bits = 0;           ///< of its indices
  int logging_level = 0;        ///< 0: none
  bool profiling = false, monitoring = false, mpi = false;
  /// Time of its vector sum over that of the same loop compiled here: about 1, or well above 2 where the
  /// library was built without optimisation. Measured now, so never twice the same.
  double slowness = 0.0;
};
SundialsBuild sundials_build();

}  // namespace mckibben::engine
