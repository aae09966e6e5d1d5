// Units of a column map; see the header.
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include <plant/instruments.hpp>
#include <sim/input/column_units.hpp>
#include <sim/input/quantity.hpp>

namespace mckibben::input {
namespace {

constexpr std::string_view count = "count";

/// Our unit of a quantity, as the name of its column ends.
std::string_view unit_of(std::string_view quantity) {
  if (quantity == "time") return "s";
  return quantity == "current" ? "mA" : "bar";
}

std::string contraction_problem(const std::string& unit) {
  if (unit == "1" || unit == "%" || unit == count) return "";
  if (unit_problem(unit, "m").empty() || unit_problem(unit, "rad").empty()) return "";
  return fmt::format(
      "{} is not a unit of contraction; wanted is 1, %, count, an angle (deg) or a length (mm)", unit);
}

/// What one of `unit` is in contraction; units that are none have been refused.
void to_ratio(std::vector<double>& values, const std::string& unit, const plant::Rig& rig) {
  double ratio = 1.0;
  if (unit == "1") return;
  if (unit == count) {
    ratio = plant::count_height_m(rig.encoder, rig.joint) / rig.muscle.rest_length_m;
  } else if (unit == "%") {
    for (double& value : values) value /= 100.0;
    return;
  } else if (unit_problem(unit, "m").empty()) {
    convert_units(values, unit, "m");
    ratio = 1.0 / rig.muscle.rest_length_m;
  } else {
    convert_units(values, unit, "rad");
    ratio = rig.joint.wheel_radius_m / rig.muscle.rest_length_m;
  }
  for (double& value : values) value *= ratio;
}

}  // namespace

void check_units(const Source& source, const Node& map, Problems& problems) {
  for (const Node& quantity : map.children) {
    const Node* unit = quantity.find("unit");
    if (unit == nullptr || unit->kind != Node::Kind::scalar) continue;
    const std::string problem = quantity.key == "contraction"
                                    ? contraction_problem(unit->text)
                                    : unit_problem(unit->text, unit_of(quantity.key));
    if (!problem.empty()) problems.error(source, unit->place, "unit = " + problem);
  }
}

void convert_columns(Table& table, const ColumnMap& map, const plant::Rig& rig) {
  const std::array<std::pair<std::string_view, const ColumnPlace*>, 4> places{
      {{"time_s", &map.time},
       {"current_mA", &map.current},
       {"contraction_ratio", &map.contraction},
       {"muscle_pressure_bar", &map.muscle_pressure}}};
  for (Table::Column& column : table.columns) {
    const auto found = std::find_if(places.begin(), places.end(),
                                    [&](const auto& each) { return each.first == column.name; });
    if (found == places.end() || found->second->absent()) continue;
    const ColumnPlace& place = *found->second;
    if (place.zero != 0.0 || place.factor != 1.0)
      for (double& value : column.values) value = (value - place.zero) * place.factor;
    if (&place == &map.contraction)
      to_ratio(column.values, place.unit, rig);
    else
      convert_units(column.values, place.unit,
                    &place == &map.time      ? "s"
                    : &place == &map.current ? "mA"
                                             : "bar");
  }
}

}  // namespace mckibben::input
