// Writes resolved input as YAML that a person would have written: one key a line, short lists in brackets.
#pragma once

#include <string>

#include <sim/input/json.hpp>

namespace mckibben::input {

/// The text of a YAML file with the contents of `object`, such as rig_json or scenario_json give.
std::string to_yaml(const Json& object);

}  // namespace mckibben::input
