// What of a rig's valve and hose passes gas: conductances at its gas's temperature.
#pragma once

#include <cmath>

#include <plant/flow.hpp>
#include <plant/rig.hpp>

namespace mckibben::plant {

/// ISO 6358: a conductance holds at the reference temperature; warmer gas is thinner.
template <class P>
RestrictionOf<P> restriction(const RigOf<P>& rig, const P& conductance_m3_per_s_Pa) {
  using std::sqrt;
  constexpr double reference_temperature_K = 293.15;
  const P warmth = sqrt(reference_temperature_K / rig.gas.temperature_K);
  return {conductance_m3_per_s_Pa * rig.gas.reference_density_kg_per_m3 * warmth, rig.valve.critical_ratio,
          rig.hose.linear_zone_Pa};
}

/// Of a valve that vents; 0 is said where it is no other than that of filling.
template <class P>
P venting_conductance(const RigOf<P>& rig) {
  const P& own = rig.valve.venting_conductance_m3_per_s_Pa;
  return rig.effects.vent_factor() * select(own > 0.0, own, rig.valve.conductance_m3_per_s_Pa);
}

}  // namespace mckibben::plant
