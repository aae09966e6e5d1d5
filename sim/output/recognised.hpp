// What import writes of tables that it recognised: dataset.yaml and rig.yaml with the reason for each guess
// in a comment, the same as a table to print and as JSON, and a picture of what it took for what.
#pragma once

#include <filesystem>
#include <string>

#include <sim/recognise/recognise.hpp>

namespace mckibben::output {

/// `folder`: where the file is to stand, as an absolute path; tables are named from there. `rig`: as the file
/// names it.
std::string dataset_yaml(const recognise::Recognised& found, const std::filesystem::path& folder,
                         const std::string& rig);
/// `base`: the rig that it starts from, as a file in the same folder names it.
std::string rig_yaml(const recognise::Recognised& found, const std::string& base);

/// `where`: the folder, as the user knows it.
std::string table_of(const recognise::Recognised& found, const std::string& where);
std::string json_of(const recognise::Recognised& found);

/// Each quantity over time, all runs in one panel, as `columns` brings it to the unit that is said.
std::string picture_of(const recognise::Recognised& found);

}  // namespace mckibben::output
