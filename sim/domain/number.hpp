// Numbers as text.
#pragma once

#include <string>
#include <vector>

namespace mckibben::domain {

/// Shortest digits that read back exactly.
std::string write_number(double value);

inline constexpr double pound_kg = 0.45359237;  ///< by definition

/// A mass as it was written, less what a conversion of its unit rounded.
std::string write_kg(double kg);

/// A mass in a name: with five digits that count, or as many as keep it apart from `others`.
std::string kg_in_name(double kg, const std::vector<double>& others);

/// The number nearest to it that has so many digits that count, at most 9: 170 for 168.4 and two.
double significant(double value, int digits);

}  // namespace mckibben::domain
