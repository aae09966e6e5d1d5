// The units that a column may be in, whatever it says.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plant/rig.hpp>
#include <sim/data/thresholds.hpp>

namespace mckibben::data {

/// What one of it is in ours.
struct Unit {
  std::string name;
  double size;
  double same = thresholds.column.same;  ///< a slope within this factor speaks for it
};

/// In contraction ratio; lengths first.
std::vector<Unit> units_of_contraction(const plant::Rig& rig);

/// In Pa, from the largest.
inline constexpr std::array<std::pair<std::string_view, double>, 6> pressure_units{
    {{"MPa", 1e6}, {"bar", 1e5}, {"psi", 6894.757}, {"kPa", 1e3}, {"mbar", 1e2}, {"Pa", 1.0}}};
std::vector<Unit> units_of_pressure();
/// In N.
std::vector<Unit> units_of_force();

/// Whether a heading says a unit, as a word of its own: `Linear pos (mm)`.
bool names_unit(std::string_view heading, std::string_view unit);

/// Null if it is none of them.
const Unit* find_unit(const std::vector<Unit>& units, std::string_view name);

}  // namespace mckibben::data
