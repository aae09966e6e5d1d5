// What the readings of that which drives a rig scatter by: a measured pressure, force or command. Hysteresis
// would go the ways of that noise, so it is smoothed before a rig follows it (judged.hpp).
#pragma once

#include <sim/domain/measurement.hpp>

namespace mckibben::data {

inline bool is_length(const domain::MeasuredColumn& column) {
  return column.channel.is("contraction");
}

/// Deviation of a reading of a column that is given. Lengths have none, nor settled points, nor commands that
/// were written down as they were sent. Where readings come fast, of those in rows of so many seconds; else
/// 0.
double noise_of_given(const domain::Measurement& recorded, const domain::MeasuredColumn& given, double row_s);

}  // namespace mckibben::data
