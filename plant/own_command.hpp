// Volts, or a pressure, that a valve takes: the way back from the current that does the same
// (Valve::current_for_mA).
#pragma once

#include <plant/valve.hpp>

namespace mckibben::plant {

/// In the unit of the valve's own commands.
inline double command_for(const Valve& valve, double current_mA) {
  const double share = (current_mA - valve.zero_current_mA) / (valve.span_current_mA - valve.zero_current_mA);
  return valve.zero_command.value + share * (valve.span_command.value - valve.zero_command.value);
}

}  // namespace mckibben::plant
