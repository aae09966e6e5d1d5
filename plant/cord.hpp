// A cord between a muscle and its joint that stretches (Kelvin and Voigt), with a mass at the muscle's end:
//   F = max(0, k s + c ds/dt) where s > 0, else it is slack      m du/dt = T - F      ds/dt = u - v
// s is the stretch, u the speed of the muscle's end, v that of the joint. The mass makes u a state of its
// own: else T, which friction and effects make depend on u, would have to be solved for u at each instant.
#pragma once

#include <string_view>

#include <plant/choose.hpp>

namespace mckibben::plant {

/// The cord; it does not stretch, and has no part in anything, unless its stiffness is given.
template <class P>
struct CordOf {
  P stiffness_N_per_m = 0.0;
  P damping_N_s_per_m = 100.0;
  P end_mass_kg = 0.1;

  /// What it is there by: no other key of it says anything without.
  static constexpr std::string_view there_by = "stiffness";

  auto absent() const { return stiffness_N_per_m == 0.0; }
  /// What it pulls with [N].
  template <class S>
  S pull_N(const S& stretch_m, const S& rate_m_per_s) const {
    const S force_N = stiffness_N_per_m * stretch_m + damping_N_s_per_m * rate_m_per_s;
    return select(stretch_m > 0.0 && force_N > 0.0, force_N, S(0.0));
  }
  /// What of that is in its spring.
  template <class S>
  S spring_N(const S& stretch_m) const {
    return stiffness_N_per_m * select(stretch_m > 0.0, stretch_m, S(0.0));
  }
  double energy_J(double stretch_m, double end_speed_m_per_s) const {
    if (absent()) return 0.0;
    return 0.5 * (spring_N(stretch_m) * stretch_m + end_mass_kg * end_speed_m_per_s * end_speed_m_per_s);
  }

  static constexpr double softest_N_per_m = 1e3;

  static void fields(auto& self, auto& visit) {
    visit("stiffness", self.stiffness_N_per_m, "N/m", 0.0, 1e8, "k_c; 0: it does not stretch");
    visit("damping", self.damping_N_s_per_m, "N.s/m", 0.0, 1e5, "c_c");
    visit("end_mass", self.end_mass_kg, "kg", 1e-3, 100.0,
          "what moves with the muscle's end: fitting, and a part of the muscle");
  }
  void rules(auto& report) const {
    if (!absent() && stiffness_N_per_m < softest_N_per_m)
      report("stiffness", "of a cord is at least 1000 N/m; 0: it does not stretch");
  }
};
using Cord = CordOf<double>;

}  // namespace mckibben::plant
