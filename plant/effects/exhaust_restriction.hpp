// The way out is narrower than the way in: a silencer that has clogged, a port of its own.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct ExhaustRestrictionOf {
  static constexpr std::string_view
      name = "exhaust_restriction",
      law = "q_a -> (1 - s) q_a: the venting valve has the conductance (1 - s) C_v",
      sentence = "the valve vents slower than it fills",
      source =
          "ISO 6358-1: each path through a valve has a sonic conductance of its own; ISO 20145 measures "
          "those of exhaust silencers by it";
  static constexpr std::array hooks{Hook::vent_factor};
  static constexpr std::array variants{Variant{"", "share", 0.0, 0.1, Sign::positive, 1e-4}};

  P share = 0.0;

  static void fields(auto& self, auto& visit) {
    visit("share", self.share, "1", 0.0, 0.98, "s, lost of the conductance; 0: absent");
  }
  auto absent() const { return share == 0.0; }
  P vent_factor() const { return 1.0 - share; }
};
using ExhaustRestriction = ExhaustRestrictionOf<double>;

}  // namespace mckibben::plant
