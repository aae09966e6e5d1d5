// Options that several verbs share, checks of their values, and "did you mean" for verbs, options and values.
// CLI11 reads the command line; the words come from its own lists, so that none is forgotten.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include <sim/cli/verbs.hpp>

namespace mckibben::cli {

/// `otherwise`: where results go without it.
void add_out(CLI::App& verb, Options& options, const std::string& otherwise = "out/<name>");
void add_json(CLI::App& verb, Options& options);
void add_threads(CLI::App& verb, Options& options);
/// --out, --json, --threads
void add_common(CLI::App& verb, Options& options, const std::string& otherwise = "out/<name>");
/// `what`: what the seed is of, and its default.
void add_seed(CLI::App& verb, Options& options, const std::string& what);
/// In which formats runs are written.
void add_formats(CLI::App& verb, Options& options);
void add_rig(CLI::App& verb, Options& options, const std::string& what);
void add_dataset(CLI::App& verb, std::string& path);

/// A value that must be one of these words, each a `kind`; help and completion show them as {a,b}.
CLI::Validator one_of(const std::string& kind, const std::vector<std::string>& words);

/// A number within these limits; anything else is a usage error that names them.
CLI::Validator from_to(double lowest, double highest);

/// A quantity such as "8.87 kg", above 0 and up to `most`; what is wrong with it is a usage error.
double positive_quantity(const std::string& text, const char* unit, double most);

/// What is wrong with the first verb or option that is none, and what may have been meant; empty if nothing.
/// CLI11 would name a missing argument instead, or nothing that helps.
std::string unknown_word(const CLI::App& app, const std::vector<std::string_view>& arguments);

/// How an option or a positional argument is called on the command line: --out, or SCENARIO.yaml.
std::vector<std::string> names_of(const CLI::Option& option);

}  // namespace mckibben::cli
