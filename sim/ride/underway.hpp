// A rig that is already on its way when it is first seen: from where its load is, how fast and with which
// acceleration, to a whole state. What cannot be seen follows from the equations: the threads carry what the
// balance of forces asks of them, within their friction; memories of effects are where they would come to
// rest, but for clocks, which go on from the run-in before the record.
#pragma once

#include <optional>

#include <sim/ride/rider.hpp>

namespace mckibben::ride {

struct Underway {
  double rise_m = 0.0, speed_m_per_s = 0.0, acceleration_m_per_s2 = 0.0;  ///< as the encoder shows them
  std::optional<double> muscle_pressure_Pa{};  ///< by a gauge; none: what the valve is asked for
  /// How far memories of effects are from rest, in their working sizes: nobody has seen what went before.
  double memories = 0.0;
  /// How far the load is off what follows from these now, where they are late: the rise was so all the while.
  double off_rise_m = 0.0, off_speed_m_per_s = 0.0, off_acceleration_m_per_s2 = 0.0;
  /// How far pressures are off what is asked for, which they follow late. None of one that is given or read.
  double off_muscle_Pa = 0.0, off_valve_Pa = 0.0;
};

/// Of a hanging load that has been started; its drive holds.
void set_off(Rider& rider, const Underway& seen);

/// Of a muscle's memories, some.
using SomeMemories = plant::SideMemory<bool>;

enum class Muscle { first, opposite };

/// Brings memories of a muscle to where they would come to rest, but for clocks (those whose rate is what it
/// was in the state `before`), and so many of their working sizes `off` it.
void rest_memories(Rider& rider, const plant::State<double>& before, double off, const SomeMemories& which,
                   Muscle muscle = Muscle::first);

}  // namespace mckibben::ride
