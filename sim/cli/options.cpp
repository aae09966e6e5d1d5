// Shared options; see the header.
#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include <sim/cli/options.hpp>
#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/suggest.hpp>
#include <sim/output/run_files.hpp>

namespace mckibben::cli {
namespace {

/// A whole number without sign or leading zeros that fits: as the scenario's own key is read.
std::string is_seed(const std::string& text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  const bool leading_zero = text.size() > 1 && text.front() == '0';
  if (read.ec == std::errc{} && read.ptr == end && !leading_zero) return "";
  return fmt::format("{} is not a whole number from 0 to 18446744073709551615", text);
}

std::string not_among(std::string_view kind, std::string_view word, const std::vector<std::string>& words,
                      const std::vector<std::string>& also_meant = {}) {
  std::vector<std::string_view> known(words.begin(), words.end());
  if (std::find(known.begin(), known.end(), word) != known.end()) return "";
  known.insert(known.end(), also_meant.begin(), also_meant.end());
  constexpr std::size_t shortest = 3;  // less is a letter or two, near to anything
  return fmt::format("unknown {} {}{}", kind, word,
                     word.size() < shortest ? "" : input::did_you_mean(word, known));
}

std::string join(const std::vector<std::string>& words) {
  const std::vector<std::string_view> views(words.begin(), words.end());
  return input::join(views);
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    if (option->nonpositional())
      for (const auto& name : names_of(*option)) names.push_back(name);
  return names;
}

}  // namespace

void add_out(CLI::App& verb, Options& options, const std::string& otherwise) {
  verb.add_option("--out", options.out, fmt::format("Results folder (default: {})", otherwise))
      ->type_name("DIR");
}

void add_json(CLI::App& verb, Options& options) {
  verb.add_flag("--json", options.json, "Print the result as one JSON document");
}

void add_common(CLI::App& verb, Options& options, const std::string& otherwise) {
  add_out(verb, options, otherwise);
  add_json(verb, options);
  add_number(verb, "--threads", options.threads, 1, 1024,
             "Threads (default: all the machine has); results do not depend on it");
}

void add_seed(CLI::App& verb, Options& options, const std::string& what) {
  const auto read = [&options](const std::string& text) { options.seed = std::stoull(text); };
  verb.add_option_function<std::string>("--seed", read, "Seed of " + what)->check(is_seed)->type_name("N");
}

void add_formats(CLI::App& verb, std::vector<std::string>& formats) {
  verb.add_option(
          "--format", formats,
          "Formats of the runs, with commas between: csv, mat (MATLAB, Octave), netcdf (NetCDF-4); CSV "
          "is always written")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of("format", {output::run_formats.begin(), output::run_formats.end()}))
      ->type_name("");
}

void add_rig(CLI::App& verb, std::string& rig, const std::string& what) {
  verb.add_option("--rig", rig, "Rig file or shipped rig " + what)->type_name("RIG");
}

void add_hypotheses_option(CLI::App& verb, std::vector<std::string>& files, const std::string& what) {
  verb.add_option("--hypothesis", files, "Laws of your own (docs/hypotheses.md) that " + what)
      ->type_name("FILE");
}

void add_input(CLI::App& verb, std::string& path, const char* name, const char* what, const char* type) {
  verb.add_option(name, path, what)->required()->type_name(type);
}

void add_measured(CLI::App& verb, std::string& path) {
  add_input(verb, path, "dataset", "Data set: its dataset.yaml or the folder", "DATASET");
}

void add_loads(CLI::App& verb, std::vector<double>& loads_kg, const std::string& example, bool none_too) {
  const auto read = [&loads_kg, none_too](const std::vector<std::string>& texts) {
    for (const auto& text : texts)
      loads_kg.push_back(positive_quantity("--load", text, "kg", 500.0, none_too));
  };
  verb.add_option_function<std::vector<std::string>>("--load", read, "Load such as " + example)
      ->allow_extra_args(false)
      ->type_name("LOAD");
}

CLI::Validator one_of(const std::string& kind, const std::vector<std::string>& words,
                      const std::vector<std::string>& also_meant) {
  const auto check = [kind, words, also_meant](std::string& text) {
    const std::string wrong = not_among(kind, text, words, also_meant);
    return wrong.empty() ? wrong : fmt::format("{} (known: {})", wrong, join(words));
  };
  std::string list;
  for (const auto& word : words) list += (list.empty() ? "{" : ",") + word;
  return {check, list + "}"};
}

CLI::Validator from_to(double lowest, double highest) {
  const auto check = [lowest, highest](const std::string& text) {
    const auto value = input::parse_number(text);
    if (value && *value >= lowest && *value <= highest) return std::string{};
    return fmt::format("{} is not a number from {:g} to {:g}", text, lowest, highest);
  };
  return {check, ""};
}

double positive_quantity(const std::string& option, const std::string& text, const char* unit, double most,
                         bool none_too) {
  double value = 0.0;
  try {
    value = input::read_quantity(text, unit);
  } catch (const input::BadQuantity& error) {
    throw CLI::ValidationError(fmt::format("{}: {}", option, error.what()));
  }
  if ((value > 0.0 || (none_too && value == 0.0)) && value <= most) return value;
  throw CLI::ValidationError(fmt::format("{}: {} must be {} and at most {}", option, text,
                                         none_too ? "0 or more" : "above 0",
                                         input::write_quantity(most, unit)));
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const auto& name : option.get_snames()) names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) names.push_back("--" + name);
  if (names.empty()) names.push_back(option.get_type_name());
  return names;
}

std::string unknown_word(const CLI::App& app, const std::vector<std::string_view>& arguments) {
  if (arguments.empty()) return "";
  std::vector<std::string> verbs;
  for (const auto* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
  const std::string_view first = arguments.front();
  if (first.empty() || first.front() != '-') {
    std::vector<std::string> words = verbs;
    words.emplace_back("--help");  // for those who try `help`
    const std::string wrong = not_among("verb", first, words);
    if (!wrong.empty()) return fmt::format("{} (verbs: {}; --help explains them)", wrong, join(verbs));
  }
  const CLI::App& verb = first.starts_with('-') ? app : *app.get_subcommand(std::string(first));
  const std::vector<std::string> known = options_of(verb);
  for (const std::string_view word : arguments) {
    if (word == "--") return "";
    const bool is_number = word.size() > 1 && (word[1] == '.' || (word[1] >= '0' && word[1] <= '9'));
    if (word.size() < 2 || word.front() != '-' || is_number) continue;
    const std::string wrong = not_among("option", word.substr(0, word.find('=')), known);
    if (!wrong.empty() && &verb == &app)
      return fmt::format("{} (options: {}; those of a verb stand after it)", wrong, join(known));
    if (!wrong.empty()) return fmt::format("{} (options of {}: {})", wrong, first, join(known));
    if (&verb == &app) return "";
  }
  return "";
}

}  // namespace mckibben::cli
