// The map `vary` of a campaign: which numbers of the rig are drawn, and how.
#pragma once

#include <sim/domain/campaign.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

/// Reads `vary` of a campaign whose rig is known; collects what is wrong with it.
void read_variation(const YamlFile& file, domain::Campaign& campaign, Problems& problems);

}  // namespace mckibben::input
