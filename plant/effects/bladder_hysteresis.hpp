// The rubber takes work in every cycle, however slow and at any pressure: its force depends on the way since
// the last reversal.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct BladderHysteresisOf {
  static constexpr std::string_view
      name = "bladder_hysteresis",
      law = "-F_h z, dz/dt = (v - |v| z) / x_h",
      sentence = "the rubber pulls against the way since the last reversal, at any pressure and speed",
      source =
          "Bouc-Wen law of a muscle's force, doi 10.1155/2014/172782, with exponent 1 and without its linear "
          "part (Dahl: Ruderman, arXiv 2212.05799)";
  static constexpr std::array hooks{Hook::pull};
  static constexpr std::array variants{
      Variant{"", "force", 0.0, 5.0, Sign::positive, 0.005, "stroke", 0.002, 0.008, 0.03}};
  static constexpr double memory_size = 1.0;
  static constexpr std::string_view memory_unit = "1";

  P force_N = 0.0, stroke_m = 0.008;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("force", self.force_N, "N", 0.0, 1e3, "F_h, half of the loop's height; 0: absent");
    visit("stroke", self.stroke_m, "m", 2e-4, 1.0, "x_h, way over which it turns round");
  }
  auto absent() const { return force_N == 0.0; }

  template <class S>
  S pull_N(const Instant<S>&, const S& wound) const {
    return -force_N * wound;
  }
  template <class S>
  S memory_rate(const Instant<S>& now, const Inflow<S>&, const S& wound) const {
    using std::abs;
    return (now.speed_m_per_s - abs(now.speed_m_per_s) * wound) / stroke_m;
  }
};
using BladderHysteresis = BladderHysteresisOf<double>;

}  // namespace mckibben::plant
