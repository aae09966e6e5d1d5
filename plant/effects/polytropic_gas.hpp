// Gas that has no time to take the walls' temperature: between isothermal (n = 1) and adiabatic (n = 1.4).
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct PolytropicGasOf {
  static constexpr std::string_view
      name = "polytropic_gas",
      law = "dP_v/dt = n R T (q_v - q_h)/V_v; dP_m/dt = n (R T q_h - P_abs dV/dt)/V",
      sentence = "pressures change faster than in gas that keeps its temperature",
      source =
          "polytropic change of state; Richer & Hurmuzlu, ASME J. Dyn. "
          "Syst. Meas. Control 122 (2000) 416-425";
  static constexpr std::array hooks{Hook::gas_exponent};
  static constexpr std::array variants{Variant{"", "exponent", 1.0, 0.2, Sign::positive, 2e-4}};

  P exponent = 1.0;

  static void fields(auto& self, auto& visit) {
    visit("exponent", self.exponent, "1", 1.0, 1.67, "n; 1: absent (isothermal)");
  }
  auto absent() const { return exponent == 1.0; }
  P gas_exponent() const { return exponent; }
};
using PolytropicGas = PolytropicGasOf<double>;

}  // namespace mckibben::plant
