// What the joint of two muscles is asked for, against what it can do.
#pragma once

#include <sim/domain/scenario.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

/// An error where no muscle is as short, a warning where the valves do not turn or stiffen the joint so far.
void check_joint_target(const YamlFile& file, const Node& node, const domain::JointTarget& target,
                        const domain::Scenario& scenario, Problems& problems);

}  // namespace mckibben::input
