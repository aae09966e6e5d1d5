// The controllers of a scenario: their names, and the files that they name: recordings, libraries, believed
// rigs, calibrations.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include <sim/input/scenario_file.hpp>
#include <sim/input/yaml_reader.hpp>

namespace mckibben::input {

/// Names of files to be, and the lines in which they stand.
using UsedNames = std::unordered_map<std::string, std::size_t>;
void check_used_name(const Source& source, const std::string& name, const Node& node, std::string_view what,
                     UsedNames& names, Problems& problems);

void check_controllers(const YamlFile& file, Scenario& scenario, Problems& problems);

}  // namespace mckibben::input
