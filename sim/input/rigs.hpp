// Rigs in files: a shipped rig by its name, a rig file by its path, or changes to either written in place.
// A rig file begins with `schema: mckibben-rig/1`, names its `base` (thesis if left out) and changes fields.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <plant/rig.hpp>
#include <sim/input/json.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {

using plant::Rig;

inline constexpr std::string_view rig_schema = "mckibben-rig/1";

/// Names of the rigs that come with the program.
std::span<const std::string_view> shipped_rigs();
bool is_shipped(std::string_view name);
/// The name of the first of them of which `holds` is true; empty if there is none.
std::string shipped_rig_where(const std::function<bool(const Rig&)>& holds);

/// The rig of that name, or of the file at that path; the files read are added to `inputs`, and what is odd
/// in them to `warnings`. Throws MissingInput, BadInput.
Rig read_rig(const std::string& name_or_path, std::vector<InputFile>& inputs,
             std::vector<Problem>* warnings = nullptr);
/// The same from the text of a rig file at hand; relative paths start at the source's folder.
Rig read_rig(Source source, std::vector<InputFile>& inputs, std::vector<Problem>* warnings = nullptr);

/// The contents of a rig file that holds every field.
Json rig_json(const Rig& rig);

/// Reads what stands under `rig` in another file: a name,
/// a path relative to the folder of `source`, or a map of changes.
void read_named(const Source& source, const Node& node, Rig& into, Problems& problems);

/// What a muscle of the user's own takes from its base without `±`, of what no two muscles share: "thesis:
/// muscle.rest_radius, valve.conductance". `file`: of the rig, or of the data set that names it. Empty where
/// the muscle's size is the base's, or nothing is taken over.
std::string taken_over(const YamlFile& file, const Rig& rig);

/// The rig over which that writes: the base of a map or of a file; a shipped rig itself.
Rig read_base(const Source& source, const Node& node);

}  // namespace mckibben::input
