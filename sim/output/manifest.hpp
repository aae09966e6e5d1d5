// What belongs to a results folder: the list of its files and their digests, which stands in the
// folder itself (.mckibben-files), and what follows from it: is the folder complete,
// and is there anything of somebody else's?
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include <sim/input/folders.hpp>

namespace mckibben::output {

/// Paths of files inside a folder, relative to it, with /.
using FileNames = std::set<std::string>;
/// The same, with each file's digest.
using Digests = std::map<std::string, std::string>;

using input::manifest_name;

/// The digest of a file, however large; empty if it is none that can be read.
std::string digest_of(const std::filesystem::path& path);

/// Whether a folder holds nothing but these files, the folders they are in, and temporary files.
bool holds_only(const std::filesystem::path& folder, const FileNames& names);

/// Whether what a folder holds is a result of this job as it was written, or a part of it, or no file at all:
/// it may be removed when the job is done again.
bool is_ours(const std::filesystem::path& folder, const std::string& job);

/// Writes the list of a result's files, once each is there as it was written and nothing else is.
/// Throws CannotWrite.
void seal(const std::filesystem::path& folder, const std::string& job, const Digests& files);

/// The digest of the list in a folder that holds all that is listed, unchanged, and nothing else; else empty.
std::string seal_of(const std::filesystem::path& folder);

/// Brings every file of a folder to the disk. Throws CannotWrite.
void bring_tree_to_disk(const std::filesystem::path& folder);

/// Removes a folder and what is in it, these names of its own last. Killed on the way, it leaves what can
/// still be told for ours by them. Throws CannotWrite.
void remove_folder(const std::filesystem::path& folder, const FileNames& last = {manifest_name});

/// `path` with the first of .old-1, .old-2, ... that is free.
std::filesystem::path first_free(const std::filesystem::path& path);

}  // namespace mckibben::output
