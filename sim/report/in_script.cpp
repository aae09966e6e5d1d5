// See the header. Lengths in m, pressures in bar.
#include <sim/input/fields_json.hpp>
#include <sim/report/in_script.hpp>

namespace mckibben::report {

std::string in_script(const input::Json& data) {
  std::string text;
  for (const char c : data.dump())
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

namespace {

input::Json muscle_json(const plant::Muscle& muscle) {
  return {{"rest_length_m", muscle.rest_length_m},
          {"rest_radius_m", muscle.rest_radius_m},
          {"braid_angle_rad", muscle.braid_angle_rad}};
}

input::Json lever_json(const plant::Lever& lever, const plant::Joint& joint) {
  const double drawn_to_rad = 90.0 * plant::degree_rad;  // where no stop says how far it turns
  input::Json arms = input::Json::array();
  for (const auto& one : lever.arms) arms.push_back({{"angle_rad", one.angle_rad}, {"arm_m", one.arm_m}});
  return {{"contraction_ratio", lever.contraction_ratio},
          {"base_m", lever.base_m},
          {"attached_m", lever.attached_m},
          {"opening_rad", lever.opening_rad},
          {"arms", arms},
          {"centre_m", lever.centre_m},
          {"load_at_m", lever.load_at_m},
          {"hangs_at_rad", lever.hangs_at_rad},
          {"lowest_rad", joint.lowest_rad > joint.nowhere_rad[0] ? joint.lowest_rad : 0.0},
          {"highest_rad", joint.highest_rad < joint.nowhere_rad[1] ? joint.highest_rad : drawn_to_rad}};
}

}  // namespace

input::Json drawn_rig_json(const plant::Rig& rig, bool gauge) {
  input::Json json = muscle_json(rig.muscle);
  json.update({{"wheel_radius_m", rig.joint.wheel_radius_m},
               {"supply_bar", rig.valve.supply_pressure_Pa / 1e5},
               {"gauge", gauge}});
  json["command"] = {{"name", plant::command_key(rig)},
                     {"title", in_unit(rig.command_unit(), "Current")},
                     {"unit", name_of(rig.command_unit())},
                     {"zero", rig.valve.zero_command},
                     {"span", rig.valve.span_command}};
  if (rig.valve.is_on_off())
    json["command"]["shut"] = rig.valve.closed_command().value_or(rig.valve.zero_command);
  if (const plant::Pair* pair = rig.pair())
    json["pair"] = {{"hangs_at_rad", pair->hangs_at_rad}, {"opposite", muscle_json(pair->opposite.muscle)}};
  if (const plant::Lever* lever = rig.lever()) json["lever"] = lever_json(*lever, rig.joint);
  if (rig.holds_a_length()) json["bench"] = true;
  return json;
}

}  // namespace mckibben::report
