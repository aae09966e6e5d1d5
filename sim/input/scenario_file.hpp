// Scenarios in files (schema mckibben-scenario/1, or mckibben-pair/1, whose rig has two muscles).
// `read_scenario` gives one complete, every default in place, or says all that is wrong.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include <sim/domain/scenario.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/json.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/source.hpp>

namespace mckibben::input {

using domain::Criterion, domain::Scenario;

/// How the warning begins that numbers of a rig are ± unknown: all scenarios on the rig have it.
inline constexpr std::string_view rig_is_unknown = "these values of the rig are ± unknown";
inline constexpr std::string_view scenario_schema = "mckibben-scenario/1", pair_schema = "mckibben-pair/1";

/// Reads a scenario and the rig files and recorded currents that it names; `warnings` are added to.
/// Throws MissingInput; BadInput with the problems of all files.
Scenario read_scenario(const std::filesystem::path& path, std::vector<Problem>& warnings);
/// The same from text at hand; relative paths start at the source's folder.
Scenario read_scenario(Source source, std::vector<Problem>& warnings);

/// The contents of a scenario file that holds every field.
Json scenario_json(const Scenario& scenario);

}  // namespace mckibben::input
