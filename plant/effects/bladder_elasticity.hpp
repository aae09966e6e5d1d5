// The rubber tube pulls back: it is stretched in girth and sheared
// against the threads when the muscle shortens. Festo's muscles, whose threads lie in the rubber, pull up to
// a limit within a few per cent of shortening: b exp(c k) + f, what is left without pressure of Sarosi's
// force. Beyond it the tube may pull on like a spring: both terms at once.
#pragma once

#include <array>
#include <utility>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

/// How the tube pulls: in proportion to the rise, up to a limit, or both at once.
enum class BladderLaw { linear, saturating, saturating_linear };
constexpr auto names(BladderLaw) {
  using enum BladderLaw;
  return std::array{std::pair{linear, std::string_view{"linear"}},
                    std::pair{saturating, std::string_view{"saturating"}},
                    std::pair{saturating_linear, std::string_view{"saturating_linear"}}};
}

template <class P>
struct BladderElasticityOf {
  static constexpr std::string_view name = "bladder_elasticity",
                                    law =
                                        "linear: -k_b x; saturating: -F_b (1 - exp(-e / e_b)); "
                                        "saturating_linear: both",
                                    sentence = "the rubber tube pulls back as the muscle shortens",
                                    source =
                                        "Klute & Hannaford, ASME J. Dyn. Syst. Meas. Control 122 (2000) "
                                        "386-388 (elastic energy of the bladder); the limit: Sarosi, "
                                        "Tehnicki vjesnik 22 (2015) 1489-1494";
  static constexpr std::array hooks{Hook::pull};
  static constexpr std::array variants{
      Variant{"linear", "stiffness", 0.0, 100.0, Sign::positive, 0.1},
      Variant{"saturating", "force", 0.0, 10.0, Sign::positive, 0.01, "ratio", 0.01, 0.04, 0.15},
      Variant{"saturating_linear", "stiffness", 0.0, 100.0, Sign::positive, 0.1, "", 0.0, 0.0, 0.0,
              "saturating"}};

  BladderLaw variant = BladderLaw::linear;
  P stiffness_N_per_m = 0.0, force_N = 0.0, ratio = 0.05;

  static void fields(auto& self, auto& visit) {
    visit("variant", self.variant, "in proportion to the rise, up to a limit, or both");
    visit("stiffness", self.stiffness_N_per_m, "N/m", 0.0, 1e4, "k_b; 0: absent");
    visit("force", self.force_N, "N", 0.0, 1e3, "F_b; 0: absent");
    visit("ratio", self.ratio, "1", 1e-3, 1.0, "e_b, contraction ratio over which F_b grows");
  }
  P spring_N_per_m() const { return variant == BladderLaw::saturating ? P(0.0) : stiffness_N_per_m; }
  P limit_N() const { return variant == BladderLaw::linear ? P(0.0) : force_N; }
  auto absent() const { return spring_N_per_m() == 0.0 && limit_N() == 0.0; }

  template <class S>
  S pull_N(const Instant<S>& now, const S&) const {
    using std::exp;
    S spring_N = -spring_N_per_m() * now.rise_m;
    if (variant == BladderLaw::linear) return spring_N;
    // Below e = 0 the exponential would run away; there it goes on straight.
    return choose(
        now.contraction_ratio < 0.0, [&] { return S(spring_N - force_N / ratio * now.contraction_ratio); },
        [&] { return S(spring_N - force_N * (1.0 - exp(-now.contraction_ratio / ratio))); });
  }
};
using BladderElasticity = BladderElasticityOf<double>;

}  // namespace mckibben::plant
