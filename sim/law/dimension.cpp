// See the header.
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include <sim/law/dimension.hpp>

namespace mckibben::law {

Dimension Dimension::times(const Dimension& other, double power) const {
  Dimension product = *this;
  for (std::size_t i = 0; i < exponents.size(); ++i) product.exponents[i] += power * other.exponents[i];
  return product;
}

bool Dimension::operator==(const Dimension& other) const {
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i < exponents.size(); ++i)
    if (!(std::abs(exponents[i] - other.exponents[i]) < rounding)) return false;
  return true;
}

std::string Dimension::unit() const {
  static const Dimension joule = newton.times(metre), watt = joule.times(second, -1.0);
  // The first that fits; then those over the usual ones.
  const std::array<std::pair<Dimension, const char*>, 4> named{
      {{newton, "N"}, {pascal, "Pa"}, {joule, "J"}, {watt, "W"}}};
  const std::array<std::pair<Dimension, const char*>, 7> parts{{{metre, "/m"},
                                                                {second, "/s"},
                                                                {metre_per_second, ".s/m"},
                                                                {metre_per_second.to_the(2.0), ".s2/m2"},
                                                                {metre.to_the(2.0), "/m2"},
                                                                {pascal, "/Pa"},
                                                                {second.to_the(-1.0), ".s"}}};
  if (is_ratio()) return "1";
  for (const auto& [dimension, name] : named)
    if (*this == dimension) return name;
  for (const auto& [dimension, name] : named)
    for (const auto& [part, part_name] : parts) {
      if (*this == dimension.times(part, -1.0)) return fmt::format("{}{}", name, part_name);
    }
  for (const auto& [dimension, name] : named)
    if (*this == dimension.to_the(-1.0)) return fmt::format("1/{}", name);
  std::string above, below;
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    const double power = std::abs(exponents[i]);
    if (power < 1e-9) continue;
    std::string& side = exponents[i] > 0.0 ? above : below;
    if (!side.empty()) side += '.';
    side += bases[i];
    if (std::abs(power - 1.0) > 1e-9) side += fmt::format("{:.4g}", power);
  }
  if (below.empty()) return above;
  if (above.empty()) above += '1';
  return below.find('.') == std::string::npos ? fmt::format("{}/{}", above, below)
                                              : fmt::format("{}/({})", above, below);
}

}  // namespace mckibben::law
