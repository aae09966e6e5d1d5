// The rubber takes work in every cycle, however slow and at any pressure: its force depends on the way since
// the last reversal. Several stops of growing width, equally strong, have a branch that bends more gently:
// the sum of Prandtl and Ishlinskii.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct BladderHysteresisOf {
  static constexpr std::string_view
      name = "bladder_hysteresis",
      law = "-F_h z, dz/dt = (v - |v| z) / x_h; of n stops: the mean of z_i over x_i = 2 i x_h/(n + 1)",
      sentence = "the rubber pulls against the way since the last reversal, at any pressure and speed",
      source =
          "Bouc-Wen law of a muscle's force, doi 10.1155/2014/172782, with exponent 1 and without its linear "
          "part (Dahl: Ruderman, arXiv 2212.05799)";
  static constexpr std::array hooks{Hook::pull};
  static constexpr std::array variants{
      Variant{"", "force", 0.0, 5.0, Sign::positive, 0.005, "stroke", 0.002, 0.008, 0.03}};
  static constexpr double memory_size = 1.0;
  static constexpr std::string_view memory_unit = "1";
  static constexpr int most_stops = 10;
  static constexpr std::size_t further_memories = most_stops - 1;

  P force_N = 0.0, stroke_m = 0.008;
  int stops = 1;

  static void fields(auto& self, auto& visit) {
    visit("force", self.force_N, "N", 0.0, 1e3, "F_h, half of the loop's height; 0: absent");
    visit("stroke", self.stroke_m, "m", 2e-4, 1.0,
          "x_h, way over which it turns round; of several, their mean");
    visit("stops", self.stops, 1, most_stops, "n, how many, each wider than the last (Prandtl-Ishlinskii)");
  }
  auto absent() const { return force_N == 0.0; }

  using Others = std::size_t;  // stops besides the first
  Others others() const { return static_cast<Others>(stops - 1); }

  template <class S>
  S pull_N(const Instant<S>&, const S& wound, const std::array<S, further_memories>& further) const {
    if (stops == 1) return -force_N * wound;
    S sum = wound;
    for (Others i = 0; i < others(); ++i) sum = sum + further[i];
    return -force_N * (sum / static_cast<double>(stops));
  }
  template <class S>
  S memory_rate(const Instant<S>& now, const Inflow<S>&, const S& wound) const {
    return rate(now, wound, 1);
  }
  /// Whether the others have to be carried.
  bool remembers_more() const { return stops > 1; }
  template <class S>
  std::array<S, further_memories> further_rates(const Instant<S>& now,
                                                const std::array<S, further_memories>& further) const {
    std::array<S, further_memories> rates;
    rates.fill(S(0.0));
    for (Others i = 0; i < others(); ++i) rates[i] = rate(now, further[i], static_cast<int>(i) + 2);
    return rates;
  }

 private:
  template <class S>
  S rate(const Instant<S>& now, const S& wound, int number) const {
    using std::abs;
    const double share = 2.0 * number / (stops + 1.0);
    return (now.speed_m_per_s - abs(now.speed_m_per_s) * wound) / (stroke_m * share);
  }
};
using BladderHysteresis = BladderHysteresisOf<double>;

}  // namespace mckibben::plant
