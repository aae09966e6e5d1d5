// Springs that a joint meets: a return spring, over the rise of the cord [N, m] or over the angle of a lever
// [N m, rad], and the ends of its way.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <plant/choose.hpp>

namespace mckibben::plant {

/// Whether a return spring pulls and pushes, or hangs slack where it would push.
enum class SpringWays { both, one };
constexpr auto names(SpringWays) {
  using enum SpringWays;
  return std::array{std::pair{both, std::string_view{"both"}}, std::pair{one, std::string_view{"one"}}};
}
constexpr bool absent(SpringWays ways) {
  return ways == SpringWays::both;
}

/// A return spring: what it pulls at 0, and how much more for each metre or radian.
template <class P>
struct SpringOf {
  P preload, stiffness;
  SpringWays ways;

  /// Of any of the rigs in lanes.
  bool is_there() const { return any(stiffness != 0.0) || any(preload != 0.0); }
  /// Against the way x where positive.
  template <class S>
  S pull(const S& x) const {
    const S pulled = preload + stiffness * x;
    return ways == SpringWays::one ? S(select(pulled > 0.0, pulled, S(0.0))) : pulled;
  }
  /// The integral of that over x [J].
  double energy_J(double x) const {
    const double pulled = pull(x);
    if (ways == SpringWays::both || stiffness == 0.0) return 0.5 * (pulled + pull(0.0)) * x;
    return 0.5 * pulled * pulled / stiffness;
  }
};

/// Contact with a stop that is so deep in, and goes on at a speed: Hunt-Crossley, never sticky.
template <class S, class P>
S contact_N(const S& depth_m, const S& speed_m_per_s, const P& stiffness_N_per_m, const P& damping_s_per_m) {
  const S force_N = stiffness_N_per_m * depth_m * (1.0 + damping_s_per_m * speed_m_per_s);
  return select(depth_m > 0.0 && force_N > 0.0, force_N, S(0.0));
}

}  // namespace mckibben::plant
