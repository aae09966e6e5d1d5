// A pressure gauge that shows too much or too little: a zero that has moved, another gain than its sheet's.
// Where the pressure is an input, it is what such a gauge showed.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

/// What is wrong with the gauge: always by the same, or in proportion.
enum class GaugeLaw { offset, gain };
constexpr auto names(GaugeLaw) {
  using enum GaugeLaw;
  return std::array{std::pair{offset, std::string_view{"offset"}}, std::pair{gain, std::string_view{"gain"}}};
}

template <class P>
struct GaugeErrorOf {
  static constexpr std::string_view name = "gauge_error",
                                    law = "offset: shows P_m + P_0; gain: shows (1 + g) P_m",
                                    sentence = "the pressure gauge shows too much or too little",
                                    source = "zero and span error of pressure transmitters, IEC 61298-2";
  static constexpr std::array hooks{Hook::gauge};
  static constexpr std::array variants{Variant{"offset", "offset", 0.0, 1e4, Sign::either, 10.0},
                                       Variant{"gain", "gain", 0.0, 0.03, Sign::either, 1e-5}};

  GaugeLaw variant = GaugeLaw::offset;
  P offset_Pa = 0.0, gain = 0.0;

  static void fields(auto& self, auto& visit) {
    visit("variant", self.variant, "always by the same, or in proportion");
    visit("offset", self.offset_Pa, "Pa", -2e5, 2e5, "offset: P_0; 0: absent");
    visit("gain", self.gain, "1", -0.5, 1.0, "gain: g; 0: absent");
  }
  auto absent() const { return (variant == GaugeLaw::offset ? offset_Pa : gain) == 0.0; }
  P gauge_offset_Pa() const { return variant == GaugeLaw::offset ? offset_Pa : P(0.0); }
  P gauge_factor() const { return variant == GaugeLaw::gain ? P(1.0 + gain) : P(1.0); }
};
using GaugeError = GaugeErrorOf<double>;

}  // namespace mckibben::plant
