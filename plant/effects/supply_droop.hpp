// A supply that gives way: a vessel before the valve, filled through a line of limited conductance.
#pragma once

#include <algorithm>
#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct SupplyDroopOf {
  static constexpr std::string_view
      name = "supply_droop",
      law = "V_s/(n R T) dP_s/dt = g_s (P_supply - P_s) - q_in, q_in = what the supply valve draws",
      sentence = "the supply pressure sinks while the valve fills the muscle",
      source = "mass balance of a vessel behind a linear restriction";
  static constexpr std::array hooks{Hook::supply_drop};
  static constexpr std::array variants{
      Variant{"", "line_resistance", 0.0, 1e8, Sign::positive, 1e6, "volume", 5e-5, 3e-4, 2e-3}};
  static constexpr double memory_size = 1e5;
  static constexpr std::string_view memory_unit = "Pa";

  P volume_m3 = 5e-4, line_resistance_s_Pa_per_kg = 0.0, exponent = 1.0;

  static void fields(auto& self, auto& visit) {
    visit("volume", self.volume_m3, "m3", 1e-6, 1.0, "V_s");
    visit("line_resistance", self.line_resistance_s_Pa_per_kg, "s.Pa/kg", 0.0, 1e15, "1/g_s; 0: absent");
    visit("exponent", self.exponent, "1", 1.0, 1.4, "n: 1 isothermal, 1.4 adiabatic");
  }
  auto absent() const { return line_resistance_s_Pa_per_kg == 0.0; }

  template <class S>
  S supply_drop_Pa(const S& drop_Pa) const {
    return drop_Pa;
  }
  template <class S>
  S memory_rate(const Instant<S>& now, const Inflow<S>& inflow, const S& drop_Pa) const {
    using std::max;
    const P stiffness_Pa_per_kg = exponent * now.gas_J_per_kg / volume_m3;
    const P resistance = max(line_resistance_s_Pa_per_kg, P(fastest_s * stiffness_Pa_per_kg));
    return stiffness_Pa_per_kg * (inflow.supply_kg_per_s - drop_Pa / resistance);
  }
};
using SupplyDroop = SupplyDroopOf<double>;

}  // namespace mckibben::plant
