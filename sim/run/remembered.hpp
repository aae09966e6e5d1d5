// Runs that began on their way: what the rig's effects remember of before was not recorded. How far their
// memories were from rest is fitted to the readings of the run (one number, by secants), so that a comparison
// shows what the rig does and not what nobody knows.
#pragma once

#include <span>

#include <sim/run/follow.hpp>

namespace mckibben::run {

/// Readings of contraction at the rows of a course, NaN where there is none; `rest_length_m`: what rises were
/// divided by; those before `from_s` are not judged.
struct Seen {
  std::span<const double> contraction_ratio;
  double rest_length_m;
  double from_s;
};

/// As `follow`; where the course begins on its way and the rig remembers, with memories that fit `seen`.
Recording follow_as_seen(const plant::Rig& rig, double load_kg, Course course, const Seen& seen);

}  // namespace mckibben::run
