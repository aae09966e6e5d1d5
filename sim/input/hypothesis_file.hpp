// Laws of a user's own (docs/hypotheses.md): a file that begins with `schema: mckibben-hypothesis/1`, or the
// same keys in a rig file. What its expressions mean, and what may be wrong with them: sim/law.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <plant/effects/own_laws.hpp>
#include <sim/input/field_list.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

inline constexpr std::string_view hypothesis_schema = "mckibben-hypothesis/1";

using OwnLaw = plant::OwnLawOf<double>;
using OwnLaws = plant::OwnLawsOf<double>;

/// The law in a file, with the values that are said there, or without size; the files read are added to
/// `inputs`. Throws MissingInput, BadInput.
OwnLaw read_hypothesis(const std::string& path, std::vector<InputFile>& inputs);

/// Reads a list of laws: paths relative to the folder of `source`, or what would stand in such files.
void read_named(const Source& source, const Node& node, OwnLaws& into, Problems& problems);

/// The keys of such a file.
std::vector<FieldInfo> hypothesis_fields();

}  // namespace mckibben::input
