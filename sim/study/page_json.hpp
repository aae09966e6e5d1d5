// A page's numbers for programs.
#pragma once

#include <string>

#include <sim/input/fields_json.hpp>
#include <sim/study/evidence.hpp>

namespace mckibben::study {

/// Mean, spread, number of rows.
input::Json json_of(const Tally& tally);

/// The text of <name>.json: what made it, and then every number of the page.
std::string document_of(const Evidence& evidence, const std::string& name, const input::Json& numbers);

}  // namespace mckibben::study
