// A valve whose reference lags behind by a play: friction of the spool, or magnetic hysteresis.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct ValveHysteresisOf {
  static constexpr std::string_view
      name = "valve_hysteresis",
      law = "the clamped P_ref passes a play of half width h, updated at each tick",
      sentence = "the valve keeps its reference pressure until the current has moved some way",
      source = "play operator; Visintin, Differential Models of Hysteresis (1994)";
  static constexpr std::array hooks{Hook::reference};
  static constexpr std::array variants{Variant{"", "half_width", 0.0, 5e3, Sign::positive, 1e3}};

  P half_width_Pa = 0.0;

  static void fields(auto& self, auto& visit) {
    visit("half_width", self.half_width_Pa, "Pa", 0.0, 2e5, "h; 0: absent");
  }
  auto absent() const { return half_width_Pa == 0.0; }
  double reference_Pa(double wanted_Pa, Play& play) const { return play.follow(wanted_Pa, half_width_Pa); }
};
using ValveHysteresis = ValveHysteresisOf<double>;

}  // namespace mckibben::plant
