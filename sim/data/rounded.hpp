// Commands that were written down with few digits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <plant/rig.hpp>

namespace mckibben::data {

/// What to say of commands that go in steps which the rig's DAC does not have; nothing where they do not, or
/// where few values say little.
std::optional<std::string> rounded(const std::vector<double>& commands, const plant::Rig& rig);

}  // namespace mckibben::data
