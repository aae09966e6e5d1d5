// Thread friction that depends on speed: falling with it (Stribeck) or rising (Tondu and Lopez).
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct SpeedDependentFrictionOf {
  static constexpr std::string_view
      name = "speed_dependent_friction",
      law = "G x [rho + (1 - rho) exp(-|v| / v_s)]",
      sentence = "thread friction that falls (rho < 1) or rises (rho > 1) with speed",
      source =
          "Stribeck (1902); Tondu & Lopez, IEEE Control Systems Magazine 20 (2000) 15-38, "
          "three-parameter friction";
  static constexpr std::array hooks{Hook::friction_factor};
  static constexpr bool in_motion = true;
  static constexpr std::array variants{
      Variant{"", "ratio", 1.0, -0.3, Sign::either, -3e-4, "speed", 0.005, 0.02, 0.08}};

  P ratio = 1.0, speed_m_per_s = 0.02;

  static void fields(auto& self, auto& visit) {
    visit("ratio", self.ratio, "1", 0.05, 5.0,
          "rho: friction at high speed over friction at rest; 1: absent");
    visit("speed", self.speed_m_per_s, "m/s", 5e-4, 1.0, "v_s: speed over which it changes");
  }
  auto absent() const { return ratio == 1.0; }

  template <class S>
  S friction_factor(const Instant<S>& now, const S&) const {
    using std::abs;
    using std::exp;
    return ratio + (1.0 - ratio) * exp(-abs(now.speed_m_per_s) / speed_m_per_s);
  }
};
using SpeedDependentFriction = SpeedDependentFrictionOf<double>;

}  // namespace mckibben::plant
