// Folders that are given in place of a file: who wrote them, and what in them to give instead.
#pragma once

#include <filesystem>
#include <string>

namespace mckibben::input {

/// In a results folder: in its first line the command that wrote it, then the files
/// (sim/output/manifest.hpp).
inline constexpr const char* manifest_name = ".mckibben-files";
/// In this line, before the digest of what is not to be read.
inline constexpr const char* secret_mark = "#";

/// For the end of a message: "; written by `mckibben run a.yaml`: give a.yaml", or "; in it: out/rig.yaml".
std::string what_to_give(const std::filesystem::path& folder);

/// The same of a folder without a dataset.yaml: how its tables become a data set.
std::string how_to_import(const std::filesystem::path& folder);

}  // namespace mckibben::input
