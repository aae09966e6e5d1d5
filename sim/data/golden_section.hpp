// Where a function of one number is least.
#pragma once

namespace mckibben::data {

/// Between two ends, to that width, where there is one such place (Kiefer 1953).
double golden_section(const auto& f, double low, double high, double width) {
  constexpr double golden = 0.6180339887498949;
  double x1 = high - golden * (high - low), x2 = low + golden * (high - low);
  double y1 = f(x1), y2 = f(x2);
  while (high - low > width) {
    if (y1 < y2) {
      high = x2, x2 = x1, y2 = y1;
      y1 = f(x1 = high - golden * (high - low));
    } else {
      low = x1, x1 = x2, y1 = y2;
      y2 = f(x2 = low + golden * (high - low));
    }
  }
  return 0.5 * (low + high);
}

}  // namespace mckibben::data
