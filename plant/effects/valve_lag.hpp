// The valve's spool needs time to follow its command.
#pragma once

#include <algorithm>
#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct ValveLagOf {
  static constexpr std::string_view name = "valve_lag", law = "tau du_a/dt = u - u_a, the valve opens by u_a",
                                    sentence = "the valve opens and closes with a delay of first order",
                                    source =
                                        "first-order spool dynamics; Sorli, Figliolini, Pastorelli, "
                                        "IEEE/ASME Trans. Mechatronics 9 (2004) 78-86";
  static constexpr std::array hooks{Hook::valve_opening};
  static constexpr std::array variants{Variant{"", "time", 0.0, 0.02, Sign::positive, 2e-3}};
  static constexpr double memory_size = 1.0;
  static constexpr std::string_view memory_unit = "1";

  P time_s = 0.0;

  static void fields(auto& self, auto& visit) { visit("time", self.time_s, "s", 0.0, 2.0, "tau; 0: absent"); }
  auto absent() const { return time_s == 0.0; }

  template <class S>
  S valve_opening(const S&, const S& opened) const {
    return opened;
  }
  template <class S>
  S memory_rate(const Instant<S>&, const Inflow<S>& inflow, const S& opened) const {
    using std::max;
    return (inflow.wanted_opening - opened) / max(time_s, P(fastest_s));
  }
};
using ValveLag = ValveLagOf<double>;

}  // namespace mckibben::plant
