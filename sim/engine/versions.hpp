// Which SUNDIALS library is linked.
#pragma once

#include <string>

namespace mckibben::engine {

/// Version of the SUNDIALS library, e.g. "6.4.1".
std::string sundials_version();

}  // namespace mckibben::engine
