// A rig that follows what drives it from stamp to stamp, whatever it is and however unequal the stamps:
// commands, given muscle pressures, a given length; one muscle or two.
//
//   settle: the first drive is held for the settling time, in steps of a tick; or the rig is on its way
//   row k = (t_k, x-); then a command is held until t_(k+1), a given pressure or length runs straight to its
//   next
#pragma once

#include <span>

#include <sim/domain/rig_file.hpp>
#include <sim/run/course.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::run {

/// Starts riders where a course begins: at rest, or on their way, with `memories` of each (ride::Underway) in
/// place of the course's. The ticks of settling that come first, under the first drive.
long start(std::span<ride::Rider> riders, const Course& course, const plant::Rig& rig,
           std::span<const double> memories = {});
/// The instant so many of these ticks before the first stamp [s].
double before_s(const Course& course, const plant::Rig& rig, long ticks);

/// Its two muscles on their wheel.
ride::Paired paired(const domain::RigFile& rig, const plant::Pair& pair);

/// A row for each stamp that has one. If the integrator gives up, the recording ends there and says why.
Recording follow(const domain::RigFile& rig, double load_kg, const Course& course);

}  // namespace mckibben::run
