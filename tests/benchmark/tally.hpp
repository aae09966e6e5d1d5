// How often something was so, with its 95 % interval.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace mckibben {

/// 95 % interval of a share (Wilson 1927), in per cent.
inline std::pair<double, double> wilson(int yes, int of) {
  constexpr double z = 1.96;
  const double n = of, p = yes / n, middle = p + z * z / (2.0 * n);
  const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n)), all = 1.0 + z * z / n;
  return {100.0 * std::max(0.0, middle - half) / all, 100.0 * (middle + half) / all};
}

struct Tally {
  int yes = 0, of = 0;
  void count(bool hit) {
    yes += hit ? 1 : 0;
    ++of;
  }
  void print(std::string_view what) const {
    if (of == 0) return;
    const auto [low, high] = wilson(yes, of);
    fmt::print("{:<48} {:>4} of {:<4} {:5.1f} % ({:.1f} to {:.1f} %)\n", what, yes, of, 100.0 * yes / of, low,
               high);
  }
};

}  // namespace mckibben
