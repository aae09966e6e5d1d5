// A rig that follows what drives it from stamp to stamp, whatever it is and however unequal the stamps:
// commands, given muscle pressures, a given length; one muscle or two.
//
//   settle: the first drive is held for the settling time, in steps of a tick; or the rig is on its way
//   row k = (t_k, x-); then a command is held until t_(k+1), a given pressure or length runs straight to its
//   next
#pragma once

#include <functional>
#include <span>

#include <sim/domain/rig_file.hpp>
#include <sim/run/course.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::run {

/// Brings a ride to the first stamp: settled, in steps of a tick, or on its way. `each_tick` is called after
/// each of these; `memories`: of each rig that is on its way (ride::Underway), in place of
/// the course's.
void for_first_stamp(
    ride::Ride& ride, const Course& course, const plant::Rig& rig, std::span<const double> memories = {},
    const std::function<void()>& each_tick = [] {});

/// A row for each stamp that has one. If the integrator gives up, the recording ends there and says why.
Recording follow(const domain::RigFile& rig, double load_kg, const Course& course);

}  // namespace mckibben::run
