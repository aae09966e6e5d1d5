// Thread friction that changes as the muscle warms up, from the start of the run, settling included.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct FrictionWarmUpOf {
  static constexpr std::string_view name = "friction_warm_up",
                                    law = "G x [1 + d (1 - exp(-t / tau))], t from the start of the run",
                                    sentence = "thread friction changes while the muscle warms up",
                                    source =
                                        "running-in of rubber and thread; first-order approach to a "
                                        "steady temperature";
  static constexpr std::array hooks{Hook::friction_factor};
  static constexpr bool in_motion = true;
  static constexpr std::array variants{
      Variant{"", "change", 0.0, -0.2, Sign::either, -2e-4, "time", 1.5, 5.0, 20.0}};
  static constexpr double memory_size = 1.0;
  static constexpr std::string_view memory_unit = "1";

  P change = 0.0, time_s = 5.0;

  static void fields(auto& self, auto& visit) {
    visit("change", self.change, "1", -0.95, 5.0, "d, in the end; 0: absent");
    visit("time", self.time_s, "s", 0.1, 1e5, "tau");
  }
  auto absent() const { return change == 0.0; }

  template <class S>
  S friction_factor(const Instant<S>&, const S& warmth) const {
    return 1.0 + change * warmth;
  }
  template <class S>
  S memory_rate(const Instant<S>&, const Inflow<S>&, const S& warmth) const {
    return (1.0 - warmth) / time_s;
  }
};
using FrictionWarmUp = FrictionWarmUpOf<double>;

}  // namespace mckibben::plant
