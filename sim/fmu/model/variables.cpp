// The list of variables; see the header.
#include <cctype>
#include <sstream>

#include <sim/domain/rig_number.hpp>
#include <sim/fmu/model/variables.hpp>

namespace mckibben::fmu {
namespace {

void add_inputs(std::vector<Variable>& list, const domain::RigFile& rig) {
  const auto current_of = [&](Reference reference, const char* name, const char* meaning,
                              const plant::Valve& valve) {
    list.push_back({.reference = reference,
                    .name = name,
                    .role = Role::input,
                    .unit = "mA",
                    .meaning = meaning,
                    .start = valve.zero_current_mA,
                    .lowest = 0.0,
                    .highest = rig.dac.largest_current_mA});
  };
  if (const plant::Pair* pair = rig.pair()) {
    current_of(current, "current_1", "asked of the DAC that drives the valve of muscle 1", rig.valve);
    current_of(opposite_current, "current_2", "the same of muscle 2", pair->opposite.valve);
  } else {
    current_of(current, "current", "asked of the DAC that drives the valve", rig.valve);
  }
  if (rig.lifts_a_load())
    list.push_back(
        {load, "load", Role::input, "kg", "mass that hangs on the wheel", false, usual_load_kg, 0.01, 500.0});
  if (rig.holds_a_length())
    list.push_back({length, "length", Role::input, "m", "length that the muscle has at the end of a step",
                    false, rig.muscle.rest_length_m, 0.01, 10.0});
}

void add_readings(std::vector<Variable>& list, const domain::RigFile& rig) {
  const auto add = [&](Reference reference, const char* name, const char* unit, const char* meaning) {
    list.push_back(
        {.reference = reference, .name = name, .role = Role::output, .unit = unit, .meaning = meaning});
  };
  add(counts, "counts", "", "what the encoder, or the sensor in its place, has counted");
  list.back().whole = true;
  if (rig.pair() != nullptr)
    add(position_read, "angle_read", "rad", "joint angle as it is counted");
  else
    add(position_read, "contraction_ratio_read", "1", "contraction ratio as it is counted");
  const bool other_gauge = rig.pair() != nullptr && rig.gauge.fitted;
  if (rig.gauge.fitted) add(gauge_pressure, "gauge_pressure", "Pa", "muscle pressure as the gauge shows it");
  if (other_gauge) add(opposite_gauge_pressure, "gauge_pressure_2", "Pa", "the same of muscle 2");
  if (rig.load_cell.fitted || rig.holds_a_length())
    add(cell_force, "cell_force", "N", "force of the cord as the load cell shows it");
}

void add_states(std::vector<Variable>& list, const domain::RigFile& rig) {
  const auto add = [&](Reference reference, const char* name, const char* unit, const char* meaning) {
    list.push_back({.reference = reference,
                    .name = std::string("true_") + name,
                    .role = Role::output,
                    .unit = unit,
                    .meaning = meaning});
  };
  add(contraction_ratio, "contraction_ratio", "1", "contraction ratio e");
  add(contraction_speed, "contraction_speed", "1/s", "its speed w");
  add(valve_pressure, "valve_pressure", "Pa", "gauge pressure in the valve P_v");
  add(muscle_pressure, "muscle_pressure", "Pa", "gauge pressure in the muscle P_m");
  add(braid_force, "braid_force", "N", "force of the braid F");
  add(friction_force, "friction_force", "N", "force of the threads' friction on the load, upwards");
  add(cord_force, "cord_force", "N", "force of the cord");
  if (rig.pair() == nullptr) return;
  add(opposite_contraction_ratio, "contraction_ratio_2", "1", "contraction ratio of muscle 2");
  add(opposite_valve_pressure, "valve_pressure_2", "Pa", "gauge pressure in its valve");
  add(opposite_muscle_pressure, "muscle_pressure_2", "Pa", "gauge pressure in it");
  add(opposite_braid_force, "braid_force_2", "N", "force of its braid");
  add(opposite_friction_force, "friction_force_2", "N",
      "force of its threads' friction, where it shortens it");
  add(opposite_cord_force, "cord_force_2", "N", "force of its cord");
}

}  // namespace

std::vector<std::string> parameter_paths(const domain::RigFile& rig) {
  return domain::paths_with_mechanics(rig);
}

namespace {

/// `terms.0.size` as `terms[0].size`, as names are built in FMI.
std::string structured(const std::string& path) {
  std::string name;
  std::istringstream parts(path);
  for (std::string part; std::getline(parts, part, '.');)
    if (std::isdigit(static_cast<unsigned char>(part.front())) != 0)
      name += '[' + part + ']';
    else
      name += (name.empty() ? "" : ".") + part;
  return name;
}

}  // namespace

std::vector<Variable> variables_of(const domain::RigFile& rig, bool true_states) {
  std::vector<Variable> list{{time_of_ride, "time", Role::time, "s", "time"}};
  add_inputs(list, rig);
  add_readings(list, rig);
  if (true_states) add_states(list, rig);
  domain::RigFile copy = rig;
  Reference reference = first_parameter;
  for (const std::string& path : parameter_paths(rig)) {
    const domain::RigNumber number = domain::find_number(copy, path);
    list.push_back({reference++, structured(path), Role::parameter, number.unit, std::string(number.meaning),
                    false, *number.value, number.lowest, number.highest});
  }
  return list;
}

}  // namespace mckibben::fmu
