// Part of the pressure is spent on stretching the tube until it lies on the braid; the rest presses.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct PressureThresholdOf {
  static constexpr std::string_view
      name = "pressure_threshold",
      law = "P_m - P_t presses on braid and threads, nothing where P_m < P_t",
      sentence = "the tube needs so much pressure before it presses on the braid",
      source =
          "tubes of some thickness and their range of working pressures: Tondu, J. Intell. Mater. Syst. "
          "Struct. 23 (2012), doi 10.1177/1045389X11435435; the threshold in its simplest form";
  static constexpr std::array hooks{Hook::pressing_shift};
  static constexpr std::array variants{Variant{"", "pressure", 0.0, 5e3, Sign::positive, 5.0}};

  P pressure_Pa = 0.0;

  static void fields(auto& self, auto& visit) {
    visit("pressure", self.pressure_Pa, "Pa", 0.0, 5e5, "P_t; 0: absent");
  }
  auto absent() const { return pressure_Pa == 0.0; }

  template <class S>
  S pressing_shift_Pa(const Instant<S>& now) const {
    const S& inside_Pa = now.muscle_pressure_Pa;
    const S below = select(inside_Pa > 0.0, S(-inside_Pa), S(0.0));  // a vacuum pulls as ever
    return select(inside_Pa < pressure_Pa, below, S(-pressure_Pa));
  }
};
using PressureThreshold = PressureThresholdOf<double>;

}  // namespace mckibben::plant
