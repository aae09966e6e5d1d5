// See the header.
#include <algorithm>
#include <cctype>

#include <plant/constants.hpp>
#include <plant/instruments.hpp>
#include <sim/data/units.hpp>

namespace mckibben::data {

std::vector<Unit> units_of_contraction(const plant::Rig& rig) {
  const double metre = 1.0 / rig.muscle.rest_length_m, radian = rig.joint.wheel_radius_m * metre;
  return {{"mm", 1e-3 * metre},
          {"cm", 1e-2 * metre},
          {"m", metre},
          {"in", 0.0254 * metre},
          {"1", 1.0},
          {"%", 0.01},
          {"count", plant::count_height_m(rig) * metre},
          {"deg", plant::degree_rad * radian},
          {"rad", radian}};
}

std::vector<Unit> units_of_pressure() {
  std::vector<Unit> units;
  for (const auto& [name, size] : pressure_units) units.push_back({std::string(name), size});
  return units;
}

bool names_unit(std::string_view heading, std::string_view unit) {
  const auto is_letter = [&](std::size_t at) {
    return at < heading.size() && std::isalnum(static_cast<unsigned char>(heading[at])) != 0;
  };
  for (std::size_t at = heading.find(unit); at != std::string_view::npos && !unit.empty();
       at = heading.find(unit, at + 1))
    if (!is_letter(at - 1) && !is_letter(at + unit.size())) return true;
  return false;
}

std::vector<Unit> units_of_force() {
  return {{"N", 1.0},
          {"kN", 1e3, thresholds.column.same_kilo},
          {"kgf", plant::gravity_m_per_s2},
          {"lbf", 4.448222}};
}

const Unit* find_unit(const std::vector<Unit>& units, std::string_view name) {
  const auto found = std::ranges::find(units, name, &Unit::name);
  return found != units.end() ? &*found : nullptr;
}

}  // namespace mckibben::data
