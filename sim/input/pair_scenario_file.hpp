// Pairs under given currents and under controllers in files (schema mckibben-pair/1). `read_pair_scenario`
// gives one complete, every default in place, or says all that is wrong.
#pragma once

#include <filesystem>
#include <string_view>

#include <sim/domain/pair_scenario.hpp>
#include <sim/input/json.hpp>
#include <sim/input/source.hpp>

namespace mckibben::input {

using domain::PairScenario, domain::TwoCurrents;

inline constexpr std::string_view pair_schema = "mckibben-pair/1";

/// Reads a file of that schema, and the rig files and recorded currents that it names. Throws MissingInput;
/// BadInput with the problems of all files.
PairScenario read_pair_scenario(const std::filesystem::path& path);
/// The same from text at hand; relative paths start at the source's folder.
PairScenario read_pair_scenario(Source source);

/// The contents of such a file that holds every field.
Json pair_scenario_json(const PairScenario& scenario);

}  // namespace mckibben::input
