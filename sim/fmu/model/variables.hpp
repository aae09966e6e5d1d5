// What an importer sees of a rig: its variables with their references, from the field lists. One list, from
// which the description is written and by which the program answers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <plant/rig.hpp>
#include <plant/signals.hpp>

namespace mckibben::fmu {

using Reference = std::uint32_t;

/// References: inputs, outputs in the order of `channels_of`, parameters in the order of the rig's file.
enum : Reference {
  time_of_ride = 0,
  current = 1,
  load = 2,
  opposite_current = 3,
  length = 4,
  outside = 5,  ///< a force, or a torque, on the joint
  first_output = 100,
  first_parameter = 1000
};

enum class Role { time, input, output, parameter };

struct Variable {
  Reference reference{};
  std::string name;
  Role role{};
  std::string unit;  ///< of inputs and outputs that of the signal (plant/signals.hpp); of parameters SI
  std::string meaning;
  bool whole = false;                               ///< an integer
  double start = 0.0, lowest = 0.0, highest = 0.0;  ///< of inputs and parameters
};

/// `true_states`: whether outputs show what no instrument does, too.
std::vector<Variable> variables_of(const plant::Rig& rig, bool true_states);

/// What outputs show, and more.
std::vector<plant::Channel> channels_of(const plant::Rig& rig);

/// The paths of what are parameters, in the order of their references.
std::vector<std::string> parameter_paths(const plant::Rig& rig);

}  // namespace mckibben::fmu
