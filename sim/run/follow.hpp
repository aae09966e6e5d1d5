// A rig that follows what drives it from stamp to stamp, whatever it is and however unequal the stamps:
// commands, given muscle pressures, a given length; one muscle or two.
//
//   settle: the first drive is held for the settling time, in steps of a tick
//   row k = (t_k, x-); then a command is held until t_(k+1), a given pressure or length runs straight to its
//   next
#pragma once

#include <functional>
#include <vector>

#include <sim/domain/rig_file.hpp>
#include <sim/ride/ride.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::run {

/// Stamps, ascending, and what acts on the rig at each: the same kinds of drive at all of them.
struct Course {
  std::vector<double> time_s;
  std::function<ride::Drive(std::size_t k)> at;
};

/// A row for each stamp. If the integrator gives up, the recording ends there and says why.
Recording follow(const domain::RigFile& rig, double load_kg, const Course& course);

}  // namespace mckibben::run
