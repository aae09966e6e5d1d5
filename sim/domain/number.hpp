// Numbers as text.
#pragma once

#include <string>

namespace mckibben::domain {

/// Shortest digits that read back exactly.
std::string write_number(double value);

/// The number nearest to it that has two digits that count: 170 for 168.4.
double two_digits(double value);

}  // namespace mckibben::domain
