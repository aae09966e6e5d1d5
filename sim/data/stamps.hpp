// What a recorder and its sensors did to readings, looked for at their own stamps, where it is plain to see:
// rows that are made of several stamps would hide it. A sensor that is at the end of its range repeats one
// value to the last digit while it scatters elsewhere; hum of the mains is a tone of 50 or 60 Hz that stands
// out of what is beside it (least squares in windows, as Lomb, Astrophysics and Space Science 39 (1976)
// 447-462).
#pragma once

#include <cstddef>
#include <vector>

#include <sim/data/finding.hpp>
#include <sim/domain/dataset.hpp>

namespace mckibben::data {

/// Readings at the end of a range become missing, hum is taken out; what was found. Of data
/// with a clock of their own, before `with_rows`; nothing is done to others.
std::vector<Finding> mend_at_stamps(domain::Dataset& data);

/// The tone of the mains in readings [Hz, their unit]; an amplitude of 0 if there is none, or the readings
/// come too slowly.
struct Tone {
  double hz = 0.0, amplitude = 0.0;
};
Tone hum_of(const std::vector<double>& time_s, const std::vector<double>& values);

/// Readings at an end of their sensor's range become missing: how many, and where that end is.
struct CutOff {
  std::size_t readings = 0;
  double at = 0.0;
};
CutOff leave_out_cut_off(std::vector<double>& values);

}  // namespace mckibben::data
