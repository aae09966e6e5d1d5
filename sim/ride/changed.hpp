// A rig that is changed while it moves: another load, effects that come, go or have another size. What a jump
// of a parameter leaves as it is goes on: where the load is and how fast, pressures, threads, and what
// effects remember that were there before.
#pragma once

#include <sim/ride/rider.hpp>

namespace mckibben::ride {

/// A rider of `other` that goes on from where this one is, at the same instant under the same drive; it has
/// as many muscles. An effect that was not there before remembers what it would if the load had stood here
/// for long; its play is in the middle, and what it makes late begins now.
Rider changed(const Rider& rider, const Loaded& other);

}  // namespace mckibben::ride
