// Dry friction of the load's guide: grows with the load, not with the pressure, as Coulomb's law has it. The
// jump at v = 0 is smoothed over a small speed.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct GuideFrictionOf {
  static constexpr std::string_view name = "guide_friction", law = "-mu m g tanh(v / v_0)",
                                    sentence = "dry friction that grows with the load, not with the pressure",
                                    source =
                                        "Coulomb's law, smoothed by tanh (Andersson, Soderberg, "
                                        "Bjorklund, Tribology Int. 40 (2007) 580-587)";
  static constexpr std::array hooks{Hook::pull};
  static constexpr bool acts_on_load = true;
  static constexpr std::array variants{
      Variant{"", "coefficient", 0.0, 0.02, Sign::positive, 2e-5, "slip_speed", 5e-4, 1e-3, 2e-3}};

  P coefficient = 0.0, slip_speed_m_per_s = 1e-3;

  static void fields(auto& self, auto& visit) {
    visit("coefficient", self.coefficient, "1", 0.0, 0.5, "mu; 0: absent");
    visit("slip_speed", self.slip_speed_m_per_s, "m/s", 1e-4, 0.1,
          "v_0: speed over which the jump at zero is smoothed");
  }
  auto absent() const { return coefficient == 0.0; }

  template <class S>
  S pull_N(const Instant<S>& now, const S&) const {
    using std::tanh;
    return -coefficient * now.weight_N * tanh(now.speed_m_per_s / slip_speed_m_per_s);
  }
};
using GuideFriction = GuideFrictionOf<double>;

}  // namespace mckibben::plant
