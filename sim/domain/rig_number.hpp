// Numbers of a rig by the path of their keys in a rig file, `muscle.rest_radius`, and the rules between them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <plant/rig.hpp>

namespace mckibben::domain {

/// A number in a rig. `value` points into the rig it was found in; null if the path leads to none.
struct RigNumber {
  double* value = nullptr;
  std::string unit;
  double lowest = 0.0, highest = 0.0;  ///< its documented range
  std::string meaning{};
};

/// Of a pair also `mechanics.link_length`, `mechanics.opposite.muscle.rest_radius`.
RigNumber find_number(plant::Rig& rig, std::string_view path);

/// The paths of all numbers of a rig, in the order of its file.
std::vector<std::string> paths_of_numbers(const plant::Rig& rig);
/// The same with those of a pair's mechanics.
std::vector<std::string> paths_with_mechanics(const plant::Rig& rig);

/// The first rule between fields that the rig breaks, in words; empty if none.
std::string broken_rule(const plant::Rig& rig);

/// A load that the muscle lifts about halfway: by its force at full pressure, in two digits.
double usual_load_kg(const plant::Rig& rig);

/// Why the rig's taut threads cannot bear a load, and whether the number is right; empty if they can. Loads
/// of other runs show what may be meant.
std::string too_heavy(double load_kg, const plant::Rig& rig, std::span<const double> others_kg = {});

/// The highest pressure that the rig's valve gives.
double most_pressure_Pa(const plant::Rig& rig);
inline constexpr double hardly_lifted = 0.02;  ///< contraction ratio
/// That the muscle cannot lift a load so far against its friction at a pressure; empty if it can.
std::string never_lifted(double load_kg, const plant::Rig& rig, double pressure_Pa,
                         std::span<const double> others_kg = {});

}  // namespace mckibben::domain
