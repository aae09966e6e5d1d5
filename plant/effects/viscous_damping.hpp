// Viscous damping of the muscle or its guide: the linear term of every friction model.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct ViscousDampingOf {
  static constexpr std::string_view name = "viscous_damping", law = "-c v",
                                    sentence = "a force against the speed, in proportion to it",
                                    source =
                                        "Newton's viscous friction; Armstrong-Helouvry et al., "
                                        "Automatica 30 (1994) 1083-1138";
  static constexpr std::array hooks{Hook::pull};
  static constexpr bool in_motion = true;
  static constexpr std::array variants{Variant{"", "damping", 0.0, 50.0, Sign::positive, 0.1}};

  P damping_N_s_per_m = 0.0;

  static void fields(auto& self, auto& visit) {
    visit("damping", self.damping_N_s_per_m, "N.s/m", 0.0, 5e3, "c; 0: absent");
  }
  auto absent() const { return damping_N_s_per_m == 0.0; }

  template <class S>
  S pull_N(const Instant<S>& now, const S&) const {
    return -damping_N_s_per_m * now.speed_m_per_s;
  }
};
using ViscousDamping = ViscousDampingOf<double>;

}  // namespace mckibben::plant
