// Thread friction: how large it can be (the level, T 4.2 and 4.6 or one of T 1.1 to 1.3) and what happens
// inside that level (a bristle with memory, LuGre: Canudas de Wit, Olsson,
// Astrom, Lischinsky, IEEE TAC 40 (1995) 419-425).
#pragma once

#include <cmath>

#include <plant/choose.hpp>
#include <plant/rig.hpp>

namespace mckibben::plant {

/// Where T 4.6 is used; its logarithm has no meaning at e = 0, so e is clamped to this range.
inline constexpr double lowest_friction_ratio = 0.005, highest_friction_ratio = 0.28;

/// The friction coefficient of T 4.6. The thesis prints 0.5 to 2.4; read as per cent (docs/equations.md).
template <class P, class S, class H>
S friction_coefficient(const FrictionOf<P>& p, const S& contraction_ratio, const H& current_speed_mA_per_s) {
  using std::log;
  S e = contraction_ratio;
  e = select(e < lowest_friction_ratio, S(lowest_friction_ratio), e);
  e = select(e > highest_friction_ratio, S(highest_friction_ratio), e);
  const H& nu = current_speed_mA_per_s;
  return 0.01 * (p.f0 + p.f1_s2_per_mA2 * nu * nu + p.f2 * e + p.f3 * log(e));
}

/// Of equal muscles side by side: each moves as one does.
template <class P>
FrictionOf<P> side_by_side(FrictionOf<P> friction, double count) {
  friction.scale = count * friction.scale;
  friction.floor_N = count * friction.floor_N;
  friction.bristle_stiffness_N_per_m = count * friction.bristle_stiffness_N_per_m;
  friction.bristle_damping_N_s_per_m = count * friction.bristle_damping_N_s_per_m;
  return friction;
}

/// Friction level G [N], never below the floor. Contact surface in m2, gauge pressure in Pa.
template <class P, class S, class H>
S friction_level_N(const FrictionOf<P>& p, const S& contraction_ratio, const S& surface_m2,
                   const S& pressure_Pa, const H& current_speed_mA_per_s) {
  using std::log;
  using std::pow;
  const S none = S(0.0);
  const S normal_N = select(pressure_Pa > 0.0, S(surface_m2 * pressure_Pa), none);  // T 4.2
  const auto pressed = normal_N > 1e-12;  // below it log and pow have no slope worth having
  S level = none;
  switch (p.law) {
    case FrictionLaw::superposition:
      level = friction_coefficient(p, contraction_ratio, current_speed_mA_per_s) * normal_N;
      break;
    case FrictionLaw::area:
      level = p.mu0 * normal_N + p.adhesion_Pa * surface_m2;
      break;
    case FrictionLaw::logarithmic:
      level = choose(
          pressed, [&] { return S(normal_N * (p.log_A - p.log_B * log(normal_N))); }, [] { return S(0.0); });
      break;
    case FrictionLaw::power:
      level = choose(
          pressed, [&] { return S(p.power_alpha * normal_N + p.power_b * pow(normal_N, p.power_c)); },
          [] { return S(0.0); });
      break;
  }
  level = select(level < 0.0, none, level);
  return p.scale * level + p.floor_N;
}

}  // namespace mckibben::plant
