// The rubber tube pulls back: it is stretched in girth and sheared against the threads when the muscle
// shortens.
#pragma once

#include <array>
#include <utility>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

/// How the tube pulls: in proportion to the rise, or to a limit.
enum class BladderLaw { linear, saturating };
constexpr auto names(BladderLaw) {
  using enum BladderLaw;
  return std::array{std::pair{linear, std::string_view{"linear"}},
                    std::pair{saturating, std::string_view{"saturating"}}};
}

template <class P>
struct BladderElasticityOf {
  static constexpr std::string_view name = "bladder_elasticity",
                                    law = "linear: -k_b x; saturating: -F_b (1 - exp(-e / e_b))",
                                    sentence = "the rubber tube pulls back as the muscle shortens",
                                    source =
                                        "Klute & Hannaford, ASME J. Dyn. Syst. Meas. Control 122 (2000) "
                                        "386-388 (elastic energy of the bladder)";
  static constexpr std::array hooks{Hook::pull};
  static constexpr std::array variants{
      Variant{"linear", "stiffness", 0.0, 100.0, Sign::positive, 0.1},
      Variant{"saturating", "force", 0.0, 10.0, Sign::positive, 0.01, "ratio", 0.02, 0.06, 0.15}};

  BladderLaw variant = BladderLaw::linear;
  P stiffness_N_per_m = 0.0, force_N = 0.0, ratio = 0.05;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("variant", self.variant, "in proportion to the rise, or up to a limit");
    visit("stiffness", self.stiffness_N_per_m, "N/m", 0.0, 1e4, "linear: k_b; 0: absent");
    visit("force", self.force_N, "N", 0.0, 1e3, "saturating: F_b; 0: absent");
    visit("ratio", self.ratio, "1", 1e-3, 1.0, "saturating: e_b, contraction ratio over which it grows");
  }
  auto absent() const { return (variant == BladderLaw::linear ? stiffness_N_per_m : force_N) == 0.0; }

  template <class S>
  S pull_N(const Instant<S>& now, const S&) const {
    using std::exp;
    if (variant == BladderLaw::linear) return -stiffness_N_per_m * now.rise_m;
    // Below e = 0 the exponential would run away; there it goes on straight.
    return choose(
        now.contraction_ratio < 0.0, [&] { return S(-force_N / ratio * now.contraction_ratio); },
        [&] { return S(-force_N * (1.0 - exp(-now.contraction_ratio / ratio))); });
  }
};
using BladderElasticity = BladderElasticityOf<double>;

}  // namespace mckibben::plant
