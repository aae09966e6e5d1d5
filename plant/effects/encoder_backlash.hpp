// The encoder's wheel hangs behind the load by a play, as a loose coupling or a slipping cord makes it.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct EncoderBacklashOf {
  static constexpr std::string_view name = "encoder_backlash",
                                    law = "the wheel is a play of full width w behind the load",
                                    sentence =
                                        "after each turn the reading stands still until the play is used up",
                                    source = "play operator; Nordin & Gutman, Automatica 38 (2002) 1633-1649";
  static constexpr std::array hooks{Hook::wheel};
  static constexpr std::array variants{Variant{"", "width", 0.0, 5e-4, Sign::positive, 1e-4}};

  P width_m = 0.0;

  static void fields(auto& self, auto& visit) {
    visit("width", self.width_m, "m", 0.0, 0.02, "w, full width; 0: absent");
  }
  auto absent() const { return width_m == 0.0; }
  double wheel_m(double rise_m, Play& play) const { return play.follow(rise_m, 0.5 * width_m); }
};
using EncoderBacklash = EncoderBacklashOf<double>;

}  // namespace mckibben::plant
