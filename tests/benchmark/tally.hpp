// How often something was so, with its 95 % interval.
#pragma once

#include <fmt/format.h>

#include <sim/diagnose/record.hpp>

namespace mckibben {

struct Tally : diagnose::Share {
  void count(bool hit) {
    yes += hit ? 1 : 0;
    ++of;
  }
  void print(std::string_view what) const {
    if (of == 0) return;
    const auto [low, high] = interval();
    fmt::print("{:<48} {:>4} of {:<4} {:5.1f} % ({:.1f} to {:.1f} %)\n", what, yes, of, 100.0 * value(),
               100.0 * low, 100.0 * high);
  }
};

}  // namespace mckibben
