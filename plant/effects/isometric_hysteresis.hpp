// A muscle that is held pulls less while its pressure rises than while it falls: the force lags behind by as
// much pressure each way, at any length.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct IsometricHysteresisOf {
  static constexpr std::string_view
      name = "isometric_hysteresis",
      law = "-F P_h/max(P, P_h) z, dz/dt = (dP/dt - |dP/dt| z) / P_z",
      sentence = "the force lags behind the pressure, at any length",
      source =
          "term of the static force of a 10 mm muscle, 15.6 kPa each way: Hunt, Graber-Tilton & Quinn 2017";
  static constexpr std::array hooks{Hook::pull};
  static constexpr std::array variants{
      Variant{"", "pressure", 0.0, 1.5e4, Sign::positive, 15.0, "turn", 2e3, 8e3, 3e4}};
  static constexpr double memory_size = 1.0;
  static constexpr std::string_view memory_unit = "1";

  P pressure_Pa = 0.0, turn_Pa = 8e3;

  static void fields(auto& self, auto& visit) {
    visit("pressure", self.pressure_Pa, "Pa", 0.0, 2e5, "P_h; 0: absent");
    visit("turn", self.turn_Pa, "Pa", 100.0, 1e6, "P_z, change of pressure over which it turns round");
  }
  auto absent() const { return pressure_Pa == 0.0; }

  template <class S>
  S pull_N(const Instant<S>& now, const S& wound) const {
    const S& pressed_Pa = now.muscle_pressure_Pa;
    return -now.braid_force_N * (pressure_Pa / select(pressed_Pa > pressure_Pa, pressed_Pa, S(pressure_Pa))) *
           wound;
  }
  template <class S>
  S memory_rate(const Instant<S>&, const Inflow<S>& inflow, const S& wound) const {
    using std::abs;
    return (inflow.pressure_rate_Pa_per_s - abs(inflow.pressure_rate_Pa_per_s) * wound) / turn_Pa;
  }
};
using IsometricHysteresis = IsometricHysteresisOf<double>;

}  // namespace mckibben::plant
