// A leak from the muscle to the atmosphere, through the tube's wall or its clamps.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct MuscleLeakOf {
  static constexpr std::string_view name = "muscle_leak",
                                    law = "ISO 6358 flow through C_l from the muscle to the atmosphere",
                                    sentence = "gas leaks from the muscle to the atmosphere",
                                    source = "ISO 6358 (choked and elliptic flow)";
  static constexpr std::array hooks{Hook::outflow};
  static constexpr std::array variants{Variant{"", "conductance", 0.0, 1e-10, Sign::positive, 1e-13}};

  P conductance_m3_per_s_Pa = 0.0;

  static void fields(auto& self, auto& visit) {
    visit("conductance", self.conductance_m3_per_s_Pa, "m3/(s.Pa)", 0.0, 1e-8, "C_l; 0: absent");
  }
  auto absent() const { return conductance_m3_per_s_Pa == 0.0; }

  template <class S>
  S outflow_kg_per_s(const Instant<S>& now) const {
    const S inside_Pa = now.muscle_pressure_Pa + now.atmosphere_Pa;
    return conductance_m3_per_s_Pa * now.unit_flow.flow_kg_per_s(inside_Pa, S(now.atmosphere_Pa));
  }
};
using MuscleLeak = MuscleLeakOf<double>;

}  // namespace mckibben::plant
