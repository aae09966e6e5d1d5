// Where results of a verb go, and how they get there; shared by the verbs that write folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sim/cli/streams.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/output/folder.hpp>

namespace mckibben::cli {

/// The folder asked for, or out/<name>.
std::filesystem::path destination(const Options& options, const std::string& name);

/// Throws output::CannotWrite if one of the files that are read is in the folder `where`: a results folder
/// replaces what stood there, or sets it aside.
void keep_apart(const std::filesystem::path& where, const std::vector<domain::InputFile>& read);

/// Tells the user on stderr, in a line.
void say(const std::string& text);

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

}  // namespace mckibben::cli
