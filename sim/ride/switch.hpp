// Valves that are open or shut: which ones a command asks for, and that they follow after their delays.
#pragma once

#include <limits>

#include <plant/side.hpp>

namespace mckibben::ride {

/// A valve does what it is asked after its delay, and nothing that is asked for less.
struct Switch {
  bool open = false, wanted = false;
  double at_s = std::numeric_limits<double>::infinity();  ///< when it does what is wanted

  void ask(bool want, double now_s, const plant::Valve& valve);
};

/// Those of a muscle's side: to the supply and to the atmosphere. One with three ports is the first.
struct Switches {
  Switch fill, vent;
  double edge_s = std::numeric_limits<double>::infinity();  ///< the next one of a pulse-width modulation

  /// A command [mA] from this instant on; what is held of the valves.
  void follow(const plant::Side& side, double current_mA, double now_s, plant::HeldSide& held);
  /// When they change by themselves; infinite if they do not.
  double next_s() const;
};

}  // namespace mckibben::ride
