// Commands with fewer values than they should have, or with more.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <plant/rig.hpp>

namespace mckibben::data {

/// What to say of commands that go in steps which the rig's DAC does not have; nothing where they do not, or
/// where few values say little.
std::optional<std::string> rounded(const std::vector<double>& commands, const plant::Rig& rig);

/// What to say of commands of many values where the valve is open or shut; nothing where they are as it is.
std::optional<std::string> between_states(const std::vector<double>& commands, const plant::Valve& valve);

}  // namespace mckibben::data
