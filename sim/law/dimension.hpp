// What a number measures, as exponents of the base units of SI. Angles count as ratios.
#pragma once

#include <array>
#include <string>

namespace mckibben::law {

struct Dimension {
  static constexpr std::array<const char*, 7> bases{"m", "kg", "s", "A", "K", "mol", "cd"};
  std::array<double, 7> exponents{};

  bool is_ratio() const { return *this == Dimension{}; }
  /// Of the product: this times the other to a power.
  Dimension times(const Dimension& other, double power = 1.0) const;
  Dimension to_the(double power) const { return Dimension{}.times(*this, power); }
  /// Equal but for rounding: exponents may be thirds.
  bool operator==(const Dimension& other) const;
  /// As people write it, readable to UDUNITS: "N/m"; "1" for a ratio.
  std::string unit() const;
};

inline constexpr Dimension ratio{}, metre{{1}}, second{{0, 0, 1}}, metre_per_second{{1, 0, -1}},
    newton{{1, 1, -2}}, pascal{{-1, 1, -2}}, kilogram_per_second{{0, 1, -1}};

/// A unit: what it measures, and how much of SI's unit it is.
struct UnitSize {
  Dimension dimension;
  double size = 1.0;
};

}  // namespace mckibben::law
