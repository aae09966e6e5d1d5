// Where results of a verb go, and how they get there; shared by the verbs that write folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sim/cli/verbs.hpp>
#include <sim/output/folder.hpp>

namespace mckibben::cli {

/// The folder asked for, or out/<name>.
std::filesystem::path destination(const Options& options, const std::string& name);

/// Throws output::CannotWrite if the folder `where` is, or holds, the folder `data` that is being read: a
/// results folder replaces what stood there.
void keep_apart(const std::filesystem::path& where, const std::filesystem::path& data);

/// Prints a result on stdout, to the byte.
void print(const std::string& text);

/// Lets a results folder take its place, and says so.
void publish(output::ResultFolder& folder, const std::filesystem::path& where);

/// Where the finished part of an interrupted result goes: beside any whole one.
std::filesystem::path beside(const std::filesystem::path& where);

/// Says what an interruption left of the result that would stand in `whole`, and how to go on. `what`: runs,
/// targets.
void say_interrupted(std::size_t finished, std::size_t all, const char* what,
                     const std::filesystem::path& whole);

/// Says on stderr what the user should know of a result.
void warn(const std::vector<std::string>& warnings);

/// Says that a folder that was not ours has been moved from `where` to `aside`, unless that is empty.
void say_moved(const std::filesystem::path& where, const std::filesystem::path& aside);

}  // namespace mckibben::cli
