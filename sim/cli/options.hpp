// Options that several verbs share, checks of their values, and "did you mean" for verbs, options and values.
// CLI11 reads the command line; the words come from its own lists, so that none is forgotten.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace mckibben::cli {

/// Exit statuses that scripts rely on (the numbers are those of sysexits.h where it has one).
enum ExitStatus : int {
  done = 0,
  criterion_not_met = 1,
  usage_error = 64,
  bad_input = 65,
  missing_input = 66,
  failure = 70,  ///< the integrator gave up, or a defect of ours
  cannot_write = 74,
  interrupted = 130,
};

/// What many verbs can be told. The options of a verb are these and its own.
struct Options {
  std::string out;  ///< results folder; empty for out/<name>, or nowhere
  bool json = false;
  unsigned threads = 0;  ///< 0: all the machine has
  std::optional<std::uint64_t> seed;
};

/// `otherwise`: where results go without it.
void add_out(CLI::App& verb, Options& options, const std::string& otherwise = "out/<name>");
void add_json(CLI::App& verb, Options& options);
/// --out, --json, --threads
void add_common(CLI::App& verb, Options& options, const std::string& otherwise = "out/<name>");
/// `what`: what the seed is of, and its default.
void add_seed(CLI::App& verb, Options& options, const std::string& what);
/// In which formats runs are written besides CSV: of output::run_formats.
void add_formats(CLI::App& verb, std::vector<std::string>& formats);
/// `rig`: a file or the name of a shipped rig.
void add_rig(CLI::App& verb, std::string& rig, const std::string& what);
/// Files of laws of the user's own, that do `what`.
void add_hypotheses_option(CLI::App& verb, std::vector<std::string>& files, const std::string& what);
/// The file that a verb takes. `what` it is, and how help calls it.
void add_input(CLI::App& verb, std::string& path, const char* name, const char* what, const char* type);
void add_measured(CLI::App& verb, std::string& path);

/// A value that must be one of these words, each a `kind`; help shows them as {a,b}. Misspelt it may also be
/// meant for one of others.
CLI::Validator one_of(const std::string& kind, const std::vector<std::string>& words,
                      const std::vector<std::string>& also_meant = {});

/// A number within these limits; anything else is a usage error that names them.
CLI::Validator from_to(double lowest, double highest);

/// A quantity such as "8.87 kg", above 0 (or 0, `none_too`) and up to `most`; what is wrong with it is a
/// usage error that names the option.
double positive_quantity(const std::string& option, const std::string& text, const char* unit, double most,
                         bool none_too = false);

/// An option that is such a number.
void add_number(CLI::App& verb, const char* name, auto& value, double lowest, double highest,
                const char* what, const char* type = "N") {
  verb.add_option(name, value, what)->check(from_to(lowest, highest))->type_name(type);
}

/// An option that is such a quantity.
void add_quantity(CLI::App& verb, const char* name, auto& value, const char* unit, double most,
                  const char* what, const char* type) {
  const auto read = [&value, option = std::string(name), unit, most](const std::string& text) {
    value = positive_quantity(option, text, unit, most);
  };
  verb.add_option_function<std::string>(name, read, what)->type_name(type);
}

/// Loads that a verb takes. `example`: of one, and what goes without them; `none_too`: 0 kg is one.
void add_loads(CLI::App& verb, std::vector<double>& loads_kg, const std::string& example,
               bool none_too = false);

/// What is wrong with the first verb or option that is none, and what may have been meant; empty if nothing.
/// CLI11 would name a missing argument instead, or nothing that helps.
std::string unknown_word(const CLI::App& app, const std::vector<std::string_view>& arguments);

/// How an option or a positional argument is called on the command line: --out, or SCENARIO.yaml.
std::vector<std::string> names_of(const CLI::Option& option);

}  // namespace mckibben::cli
