// Stands in for libcomedi in tests: one board, /dev/comedi0, whose output drives a simulated rig and whose
// counter of 24 bits, soon at its end, counts what the rig's encoder says.
#pragma once

#include <sim/bench/device.hpp>

namespace mckibben::bench {

struct StandIn {
  Clock* clock = nullptr;  ///< its time; the machine's if none
  bool in_mA = false;      ///< whether its output has a range in mA beside that in volts
  bool unplugged = false;
  unsigned written = 0;  ///< the last number that its output was given
  int line_of_a = -1, line_of_b = -1;
};

StandIn& stand_in();

}  // namespace mckibben::bench
