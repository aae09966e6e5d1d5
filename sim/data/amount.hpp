// Amounts of what was read: in the units in which they are told, and what a sensor's count is of it.
#pragma once

#include <string>
#include <string_view>

#include <sim/domain/dataset.hpp>

namespace mckibben::data {

using domain::Judged;

/// In what the judged reading is told: mm of the load's height, N, deg, mbar.
struct Shown {
  std::string_view unit;
  double size;   ///< of one, in what it is calculated in
  int decimals;  ///< in tables
};
Shown shown_in(Judged judged, const plant::Rig& rig);

/// An amount of the judged reading: "1.2 mm" of the load's height, "3.4 N", "0.25 deg".
std::string amount_of(Judged judged, double value, const plant::Rig& rig, int digits = 2);

/// The unit in which readings of it are calculated: Pa of what its columns hold in bar.
std::string_view si_unit(const plant::Signal& signal);

/// One count of the encoder in the reading that is judged: contraction ratio, or joint angle [rad] of a pair.
double reading_per_count(const plant::Rig& rig);

/// What checks of readings may take for a move, in the same: a count. A sensor that is finer than the
/// thesis's encoder is looked at as coarsely, since that is what they were tried with, and one that scatters
/// more, more coarsely.
double reading_grain(domain::Judged judged, const plant::Rig& rig);

}  // namespace mckibben::data
