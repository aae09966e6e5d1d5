// How often something was so, with its 95 % interval.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace mckibben {

struct Tally {
  int yes = 0, of = 0;

  void count(bool hit) {
    yes += hit ? 1 : 0;
    ++of;
  }
  /// Wilson, J. Amer. Statist. Assoc. 22 (1927) 209-212.
  std::array<double, 2> interval() const {
    constexpr double z = 1.96;
    const double n = of, p = yes / n, middle = p + z * z / (2.0 * n);
    const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n)), all = 1.0 + z * z / n;
    return {std::max(0.0, middle - half) / all, std::min(1.0, (middle + half) / all)};
  }
  void print(std::string_view what) const {
    if (of == 0) return;
    const auto [low, high] = interval();
    fmt::print("{:<48} {:>4} of {:<4} {:5.1f} % ({:.1f} to {:.1f} %)\n", what, yes, of, 100.0 * yes / of,
               100.0 * low, 100.0 * high);
  }
};

}  // namespace mckibben
