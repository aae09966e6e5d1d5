// The muscle's ends grow more conical with pressure: k of T 2.8 depends on it.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct EndCapCorrectionOf {
  static constexpr std::string_view name = "end_cap_correction",
                                    law = "k = k_0 + k_1 P_m / (1 bar), in the force only",
                                    sentence = "the correction for the conical ends depends on pressure",
                                    source =
                                        "k: Tondu & Lopez, IEEE Control Systems Magazine 20 (2000) 15-38; "
                                        "its change with pressure to first order";
  static constexpr std::array hooks{Hook::end_correction_shift};
  static constexpr std::array variants{Variant{"", "slope", 0.0, 0.01, Sign::either, 1e-5}};

  P slope = 0.0;

  static void fields(auto& self, auto& visit) {
    visit("slope", self.slope, "1", -0.2, 0.2, "k_1, for each bar of gauge pressure; 0: absent");
  }
  auto absent() const { return slope == 0.0; }

  template <class S>
  S end_correction_shift(const Instant<S>& now) const {
    return slope * now.muscle_pressure_Pa / 1e5;
  }
};
using EndCapCorrection = EndCapCorrectionOf<double>;

}  // namespace mckibben::plant
