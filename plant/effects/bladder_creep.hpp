// Creep of the rubber: a spring that forgets (a Maxwell element beside the muscle).
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct BladderCreepOf {
  static constexpr std::string_view name = "bladder_creep", law = "-k_c (x - x_c), tau dx_c/dt = x - x_c",
                                    sentence = "the rubber pulls back after a move and then gives way",
                                    source =
                                        "Maxwell element; on creep of a muscle: Minh, Kamers, Ramon, "
                                        "Van Brussel, Mechatronics 22 (2012) 923-933";
  static constexpr std::array hooks{Hook::pull};
  static constexpr bool in_motion = true;
  static constexpr std::array variants{
      Variant{"", "stiffness", 0.0, 100.0, Sign::positive, 0.1, "time", 0.3, 1.5, 8.0}};
  static constexpr double memory_size = 0.1;
  static constexpr std::string_view memory_unit = "m";

  P stiffness_N_per_m = 0.0, time_s = 1.0;

  static void fields(auto& self, auto& visit) {
    visit("stiffness", self.stiffness_N_per_m, "N/m", 0.0, 1e4, "k_c; 0: absent");
    visit("time", self.time_s, "s", 0.02, 1000.0, "tau");
  }
  auto absent() const { return stiffness_N_per_m == 0.0; }

  template <class S>
  S pull_N(const Instant<S>& now, const S& crept_m) const {
    return -stiffness_N_per_m * (now.rise_m - crept_m);
  }
  template <class S>
  S memory_rate(const Instant<S>& now, const Inflow<S>&, const S& crept_m) const {
    return (now.rise_m - crept_m) / time_s;
  }
};
using BladderCreep = BladderCreepOf<double>;

}  // namespace mckibben::plant
