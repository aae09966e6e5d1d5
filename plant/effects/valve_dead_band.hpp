// A valve that does nothing about small errors: overlap of the spool.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct ValveDeadBandOf {
  static constexpr std::string_view
      name = "valve_dead_band",
      law = "the error P_ref - P_v acts only beyond +-delta, less delta",
      sentence = "the valve does nothing about pressure errors below a threshold",
      source =
          "spool overlap; Tao & Kokotovic, Adaptive Control of Systems with Actuator and Sensor "
          "Nonlinearities (1996)";
  static constexpr std::array hooks{Hook::valve_error_shift};
  static constexpr std::array variants{Variant{"", "half_width", 0.0, 5e3, Sign::positive, 100.0}};

  P half_width_Pa = 0.0;

  static void fields(auto& self, auto& visit) {
    visit("half_width", self.half_width_Pa, "Pa", 0.0, 2e5, "delta; 0: absent");
  }
  auto absent() const { return half_width_Pa == 0.0; }

  template <class S>
  S valve_error_shift_Pa(const S& error_Pa) const {
    const S below = select(error_Pa < -half_width_Pa, S(half_width_Pa), S(-error_Pa));
    return select(error_Pa > half_width_Pa, S(-half_width_Pa), below);
  }
};
using ValveDeadBand = ValveDeadBandOf<double>;

}  // namespace mckibben::plant
