// The thesis's rig with a regulator in place of its servo valve; shared by the tests of this room.
#pragma once

#include <plant/rig.hpp>

namespace mckibben::plant {

inline Rig quick_regulator(double time_constant_s) {
  Rig rig;
  rig.valve.kind = ValveKind::regulator;
  rig.valve.time_constant_s = time_constant_s;
  return rig;
}

inline Rig swinging_regulator(double natural_frequency_Hz, double damping) {
  Rig rig = quick_regulator(0.0);
  rig.valve.lag = RegulatorLag::second_order;
  rig.valve.natural_frequency_Hz = natural_frequency_Hz;
  rig.valve.damping = damping;
  return rig;
}

}  // namespace mckibben::plant
