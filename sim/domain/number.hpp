// Numbers as text.
#pragma once

#include <string>

namespace mckibben::domain {

/// Shortest digits that read back exactly.
std::string write_number(double value);

}  // namespace mckibben::domain
