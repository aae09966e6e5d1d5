// The list of variables; see the header.
#include <cctype>
#include <sstream>

#include <sim/domain/outer_force.hpp>
#include <sim/domain/rig_number.hpp>
#include <sim/fmu/model/variables.hpp>

namespace mckibben::fmu {
namespace {

Variable of_channel(Reference reference, const plant::Channel& channel, Role role) {
  return {.reference = reference,
          .name = channel.key(),
          .role = role,
          .unit = channel.signal->whole ? std::string() : std::string(channel.signal->unit.name),
          .meaning = channel.words(),
          .whole = channel.signal->whole};
}

void add_inputs(std::vector<Variable>& list, const plant::Rig& rig) {
  for (const plant::Channel& channel : channels_of(rig)) {
    if (channel.signal->kind != plant::Kind::input) continue;
    if (!channel.signal->of_commands_in) {
      list.push_back(of_channel(outside, channel, Role::input));
      list.back().lowest = -(list.back().highest = domain::largest_outside);
      continue;
    }
    const bool second = channel.muscle == 2;
    list.push_back(of_channel(second ? opposite_current : current, channel, Role::input));
    list.back().start = (second ? rig.pair()->opposite.valve : rig.valve).zero_command;
    list.back().lowest = rig.dac.lowest_command;
    list.back().highest = rig.dac.largest_command;
  }
  if (rig.lifts_a_load())
    list.push_back({load, "load", Role::input, "kg",
                    rig.lever() != nullptr ? "mass of the load on the lever" : "mass that hangs on the wheel",
                    false, domain::usual_load_kg(rig), 0.01, 500.0});
  if (rig.holds_a_length())
    list.push_back({length, "length", Role::input, "m", "length that the muscle has at the end of a step",
                    false, rig.muscle.rest_length_m, 0.01, 10.0});
}

void add_outputs(std::vector<Variable>& list, const plant::Rig& rig, bool true_states) {
  const std::vector<plant::Channel> channels = channels_of(rig);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const plant::Kind kind = channels[i].signal->kind;
    if (kind == plant::Kind::reading || (true_states && kind == plant::Kind::state))
      list.push_back(of_channel(first_output + static_cast<Reference>(i), channels[i], Role::output));
  }
}

}  // namespace

std::vector<plant::Channel> channels_of(const plant::Rig& rig) {
  plant::Rig seen = rig;
  if (rig.holds_a_length() && seen.sensors.of(plant::Sensed::force) == nullptr)  // a bench has one
    seen.sensors.put({.signal = plant::Sensed::force, .kind = plant::SensorKind::load_cell});
  return plant::channels_of(
      seen,
      {.pair = rig.pair() != nullptr, .length = rig.holds_a_length(), .joint_force = !rig.holds_a_length()});
}

std::vector<std::string> parameter_paths(const plant::Rig& rig) {
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

std::vector<Variable> variables_of(const plant::Rig& rig, bool true_states) {
  std::vector<Variable> list{{time_of_ride, "time", Role::time, "s", "time"}};
  add_inputs(list, rig);
  add_outputs(list, rig, true_states);
  plant::Rig copy = rig;
  Reference reference = first_parameter;
  for (const std::string& path : parameter_paths(rig)) {
    const domain::RigNumber number = domain::find_number(copy, path);
    list.push_back({reference++, structured(path), Role::parameter, number.unit, std::string(number.meaning),
                    false, *number.value, number.lowest, number.highest});
  }
  return list;
}

}  // namespace mckibben::fmu
