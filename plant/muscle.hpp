// A muscle's parameters: braid and tube, and the friction of its threads. Laws: geometry.hpp, friction.hpp.
// How fields are listed: rig.hpp.
#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <plant/constants.hpp>
#include <plant/cord.hpp>

namespace mckibben::plant {

/// How the thread contact surface is computed (T 4.3):
/// `squared` is exact geometry, `printed` as the thesis prints it.
enum class ContactSurface { squared, printed };
constexpr auto names(ContactSurface) {
  using enum ContactSurface;
  return std::array{std::pair{squared, std::string_view{"squared"}},
                    std::pair{printed, std::string_view{"printed"}}};
}

/// Which law gives the friction level from normal force and contact (T 4.6; T 1.1, 1.2, 1.3).
enum class FrictionLaw { superposition, area, logarithmic, power };
constexpr auto names(FrictionLaw) {
  using enum FrictionLaw;
  return std::array{
      std::pair{superposition, std::string_view{"superposition"}}, std::pair{area, std::string_view{"area"}},
      std::pair{logarithmic, std::string_view{"logarithmic"}}, std::pair{power, std::string_view{"power"}}};
}

/// What happens inside the friction level: a bristle that remembers (LuGre),
/// or exact stick and slip (Coulomb).
enum class FrictionMemory { lugre, coulomb };
constexpr auto names(FrictionMemory) {
  using enum FrictionMemory;
  return std::array{std::pair{lugre, std::string_view{"lugre"}},
                    std::pair{coulomb, std::string_view{"coulomb"}}};
}

/// Braid and tube of one muscle (T 2.4 to 2.10), and how many such pull side by side.
template <class P>
struct MuscleOf {
  int count = 1;
  P rest_length_m = 0.300;
  P rest_radius_m = 7.5e-3;
  P braid_angle_rad = 20.0 * degree_rad;
  P end_correction = 1.30;
  P end_length_m = 0.0;
  P dead_volume_m3 = 5.0e-6;
  P stop_stiffness_N_per_m = 3.0e5;
  P stop_damping_s_per_m = 19.0;
  ContactSurface contact_surface = ContactSurface::squared;
  CordOf<P> cord;

  static void fields(auto& self, auto& visit) {
    visit("count", self.count, 1, 100, "equal muscles side by side on one cord, each with a hose");
    visit("rest_length", self.rest_length_m, "m", 0.01, 5.0, "length at rest, l0 (T 2.4)");
    visit("rest_radius", self.rest_radius_m, "m", 5e-4, 0.2, "radius at rest, r0 (T 2.5)");
    visit("braid_angle", self.braid_angle_rad, "rad", 5.0 * degree_rad, 50.0 * degree_rad,
          "angle between thread and axis at rest, alpha0 (T 2.6)");
    visit("end_correction", self.end_correction, "1", 1.0, 2.5, "correction for the conical ends, k (T 2.8)");
    visit("end_length", self.end_length_m, "m", 0.0, 1.0,
          "of the ends, which pull less: forces are less by its share of rest_length");
    visit("dead_volume", self.dead_volume_m3, "m3", 0.0, 1e-2, "gas volume of the fittings, V_d");
    visit("stop_stiffness", self.stop_stiffness_N_per_m, "N/m", 1e3, 1e8,
          "taut threads, e < 0: stiffness k_s; if left out, at least what bears all that the muscle lifts");
    visit("stop_damping", self.stop_damping_s_per_m, "s/m", 0.0, 1e3,
          "taut threads: Hunt-Crossley damping chi");
    visit("contact_surface", self.contact_surface, "cos^2 (geometry) or cos (as the thesis prints 4.3)");
    visit("cord", self.cord, "between muscle and joint, where it stretches; of all muscles side by side");
  }
  void rules(auto& report) const {
    if (3.0 * std::cos(braid_angle_rad) * std::cos(braid_angle_rad) <= 1.0)
      report("braid_angle", "must be below 54.7 deg, where the braid no longer pulls");
    if (end_length_m > 0.5 * rest_length_m) report("end_length", "must not be above half of rest_length");
  }
};
using Muscle = MuscleOf<double>;

/// Thread friction: level law and memory (T 2.11, 4.2, 4.6; Canudas de Wit et al. 1995 for the bristle).
template <class P>
struct FrictionOf {
  FrictionLaw law = FrictionLaw::superposition;
  FrictionMemory memory = FrictionMemory::lugre;
  P scale = 1.0;
  P f0 = 4.6937, f1_s2_per_mA2 = 0.0, f2 = -13.9715, f3 = 0.5306;
  P mu0 = 0.015, adhesion_Pa = 0.0;
  P log_A = 0.05, log_B = 0.004;
  P power_alpha = 0.005, power_b = 0.05, power_c = 0.8;
  P bristle_stiffness_N_per_m = 4.0e5;
  P bristle_damping_N_s_per_m = 400.0;
  P floor_N = 1.0;

  static void fields(auto& self, auto& visit) {
    visit("law", self.law,
          "friction level: T 4.6 (superposition), T 1.1 (area), T 1.2 (logarithmic), T 1.3 (power)");
    visit("memory", self.memory,
          "bristle with memory (lugre) or exact stick and slip by event detection (coulomb)");
    visit("scale", self.scale, "1", 0.0, 20.0, "factor on the whole friction level");
    visit("f0", self.f0, "1", -100.0, 100.0, "T 4.6, in per cent");
    visit("f1", self.f1_s2_per_mA2, "s2/mA2", -1.0, 1.0,
          "T 4.6: factor of the squared current speed, in per cent");
    visit("f2", self.f2, "1", -200.0, 200.0, "T 4.6: factor of the contraction ratio, in per cent");
    visit("f3", self.f3, "1", -20.0, 20.0, "T 4.6: factor of its logarithm, in per cent");
    visit("mu0", self.mu0, "1", 0.0, 1.0, "T 1.1: F = mu0 N + adhesion S");
    visit("adhesion", self.adhesion_Pa, "Pa", 0.0, 1e6,
          "T 1.1: friction force for each area of contact, alpha");
    visit("log_A", self.log_A, "1", -1.0, 1.0, "T 1.2: F/N = A - B log N, N in newton");
    visit("log_B", self.log_B, "1", -0.1, 0.1, "T 1.2");
    visit("power_alpha", self.power_alpha, "1", 0.0, 1.0, "T 1.3: F = alpha N + b N^c, N in newton");
    visit("power_b", self.power_b, "1", 0.0, 10.0, "T 1.3: b, in N^(1-c)");
    visit("power_c", self.power_c, "1", 0.1, 1.0, "T 1.3: exponent c");
    visit("bristle_stiffness", self.bristle_stiffness_N_per_m, "N/m", 1e3, 1e8, "sigma0");
    visit("bristle_damping", self.bristle_damping_N_s_per_m, "N.s/m", 0.0, 1e5, "sigma1");
    visit("floor", self.floor_N, "N", 1e-3, 100.0,
          "added to the level: keeps the bristle finite at zero pressure");
  }
};
using Friction = FrictionOf<double>;

}  // namespace mckibben::plant
