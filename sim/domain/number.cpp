// std::to_chars; see the header.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <sim/domain/number.hpp>

namespace mckibben::domain {

std::string write_number(double value) {
  // Without exponent where that stays readable.
  const double size = std::abs(value);
  const bool plain = size == 0.0 || (size >= 1e-4 && size < 1e9);
  std::array<char, 48> digits{};
  char* const last = digits.data() + digits.size();
  const auto [end, error] = plain ? std::to_chars(digits.data(), last, value, std::chars_format::fixed)
                                  : std::to_chars(digits.data(), last, value);
  return {digits.data(), end};
}

std::string write_kg(double kg) {
  constexpr int written = 9;
  return write_number(significant(kg, written));
}

std::string kg_in_name(double kg, const std::vector<double>& others) {
  constexpr int least = 5, most = 9;
  for (int digits = least; digits <= most; ++digits) {
    const double said = significant(kg, digits);
    if (std::ranges::none_of(others,
                             [&](double other) { return other != kg && significant(other, digits) == said; }))
      return write_number(said);
  }
  return write_number(kg);
}

double significant(double value, int digits) {
  std::array<char, 24> text{};
  const auto written =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, digits - 1);
  std::from_chars(text.data(), written.ptr, value);
  return value;
}

}  // namespace mckibben::domain
