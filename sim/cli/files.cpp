// The verbs about files: check, schema.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/data/plausible.hpp>
#include <sim/input/calibration_file.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/field_list.hpp>
#include <sim/input/finding_places.hpp>
#include <sim/input/hypothesis_file.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/input/suggest.hpp>
#include <sim/input/upgrade.hpp>
#include <sim/input/utf8.hpp>
#include <sim/input/yaml_file.hpp>
#include <sim/input/yaml_writer.hpp>
#include <sim/output/run_files.hpp>
#include <sim/run/exchanged.hpp>
#include <sim/run/look.hpp>

namespace mckibben::cli {
namespace {

using input::Json;
using input::Problem;

constexpr std::string_view known_schemas[] = {
    input::scenario_schema, input::campaign_schema,    input::rig_schema,       input::dataset_schema,
    input::pair_schema,     input::calibration_schema, input::hypothesis_schema};

/// What was looked at besides the file's text, and why `diagnose` would find little or nothing in it.
struct Looked {
  std::string at;
  std::vector<std::string> diagnose{};
  std::string base{};  ///< what the rig takes over from it
};

/// Reads a data set and looks at what it says; adds warnings. Throws what is wrong with it.
Looked read_measured(const std::filesystem::path& path, std::vector<Problem>& warnings) {
  const domain::Dataset data = input::read_dataset(path);
  for (const std::string& remark : data.remarks)
    warnings.push_back({input::Severity::warning, data.path.string(), input::nowhere, remark, ""});
  const auto say = [&](const std::vector<data::Finding>& findings) {
    for (Problem& one : input::problems_of(data.path, with_runs_named(data, findings)))
      warnings.push_back(std::move(one));
    if (std::ranges::any_of(warnings,
                            [](const Problem& one) { return one.severity == input::Severity::error; }))
      throw input::BadInput(warnings);
  };
  say(run::asked_of(data));
  if (std::string why = input::why_unfit(domain::Purpose::judging, data); !why.empty())
    return {
        fmt::format("{} runs read; none simulated", data.runs.size()), {"cannot take it yet: " + why}, ""};
  run::Look look = run::look(data);
  Looked looked{fmt::format("{} of {} runs simulated: stroke, sign, units, order of loads", look.runs,
                            data.runs.size())};
  std::erase_if(look.findings, [&](const data::Finding& one) {
    if (data::only_limits_diagnosis(one)) looked.diagnose.push_back(data::text_of(data, one));
    return data::only_limits_diagnosis(one);
  });
  say(look.findings);
  looked.base = input::taken_over(input::load_yaml(data.path), data.rig);
  return looked;
}

/// Reads a file as what its `schema:` says it is; adds warnings. Throws what is wrong with it. Returns what
/// was looked at besides.
Looked read_any(const std::filesystem::path& path, std::vector<Problem>& warnings) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return read_measured(path, warnings);
  const input::YamlFile file = input::load_yaml(path);
  const input::Node* schema = file.root.find("schema");
  const std::string kind = schema == nullptr ? "" : schema->text.substr(0, schema->text.find('/'));
  std::vector<domain::InputFile> inputs;
  if (kind == "mckibben-rig") {
    const plant::Rig rig = input::read_rig(path.string(), inputs, &warnings);
    return {"", {}, input::taken_over(file, rig)};
  } else if (kind == "mckibben-dataset") {
    return read_measured(path, warnings);
  } else if (kind == "mckibben-campaign") {
    input::read_campaign(path, &warnings);
  } else if (kind == "mckibben-calibration") {
    input::read_calibration(path, inputs);
  } else if (kind == "mckibben-scenario" || kind == "mckibben-pair") {
    input::read_scenario(path, warnings);
  } else if (kind == "mckibben-hypothesis") {
    input::read_hypothesis(path.string(), inputs);
  } else {
    input::Problems problems;
    if (schema == nullptr)
      problems.error(
          file.source, file.root.place,
          fmt::format("the file must say what it is: schema: one of {}", input::join(known_schemas)));
    else
      problems.error(
          file.source, schema->place,
          fmt::format("unknown schema {}{} (known: {})", input::shortened(schema->text),
                      input::did_you_mean(schema->text, known_schemas), input::join(known_schemas)));
    problems.raise();
  }
  return {};
}

Json problem_json(const Problem& problem) {
  Json entry{{"file", problem.file}};
  if (problem.place.line > 0) {
    entry["line"] = problem.place.line;
    entry["column"] = problem.place.column;
  }
  entry["severity"] = problem.severity == input::Severity::warning ? "warning" : "error";
  entry["message"] = problem.message;
  return entry;
}

/// In the order of the reference page.
struct Kind {
  std::string name;  ///< of `schema`
  std::string_view schema;
  std::string title;
  std::vector<input::FieldInfo> fields;
};
std::vector<Kind> all_kinds() {
  using namespace input;
  return {{"scenario", scenario_schema, "Scenario", list_fields<domain::Scenario>()},
          {"campaign", campaign_schema, "Campaign", list_fields<domain::Campaign>()},
          {"rig", rig_schema, "Rig", list_fields<plant::Rig>()},
          {"dataset", dataset_schema, "Data set", list_fields<domain::Dataset>()},
          {"pair", pair_schema, "Pair", list_fields(domain::pair_scenario())},
          {"lever", scenario_schema, "Lever", list_fields(domain::lever_scenario())},
          {"hypothesis", hypothesis_schema, "Hypothesis", hypothesis_fields()}};
}

Json columns_json() {
  Json list = Json::array();
  for (const plant::Signal& signal : plant::signals) {
    const plant::Channel channel{
        &signal, signal.needs == plant::Needs::pair && signal.part == plant::Part::muscle ? 1U : 0U};
    list.push_back({{"column", channel.name()}, {"unit", signal.unit.name}, {"meaning", channel.words()}});
  }
  return list;
}

/// The file that says what a folder is.
std::filesystem::path described_by(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored) ? path / "dataset.yaml" : path;
}

struct CheckOptions : Options {
  std::vector<std::string> files;
  bool upgrade = false;
};

int check_files(const CheckOptions& options) {
  namespace fs = std::filesystem;
  int status = done;
  Json findings = Json::array();
  std::set<std::tuple<fs::path, std::string, std::string>> said_of_rigs;  // folder, line, message
  for (const auto& path : options.files) {
    std::vector<Problem> found;
    int file_status = done;
    std::string missing;
    Looked looked;
    try {
      if (options.upgrade) {
        found = input::to_upgrade(input::load_yaml(described_by(path)), known_schemas);
        file_status = found.empty() ? done : bad_input;
        looked.at = "as this version wants it";
      } else {
        looked = read_any(path, found);
      }
    } catch (const input::BadInput& bad) {
      file_status = bad_input;
      found = bad.problems();
    } catch (const input::MissingInput& error) {
      file_status = missing_input;
      missing = error.what();
    }
    status = status == done ? file_status : status;
    Json entry{{"file", path}, {"ok", file_status == done}, {"problems", Json::array()}};
    for (const auto& problem : found) {
      entry["problems"].push_back(problem_json(problem));
      const bool of_rig = problem.message.starts_with(input::rig_is_unknown);
      if (of_rig &&
          !said_of_rigs.insert({fs::path(path).parent_path(), problem.source_line, problem.message}).second)
        continue;
      fmt::print(stderr, "{}\n", to_text(problem));
    }
    if (!missing.empty()) {
      entry["problems"].push_back({{"file", path}, {"severity", "error"}, {"message", missing}});
      fmt::print(stderr, "mckibben: {}\n", missing);
    }
    if (!looked.at.empty()) entry["looked_at"] = looked.at;
    if (!looked.diagnose.empty()) entry["diagnose"] = looked.diagnose;
    if (!looked.base.empty()) entry["base"] = looked.base;
    findings.push_back(std::move(entry));
    if (file_status != done || options.json) continue;
    print(fmt::format("{}: ok{}\n", path, looked.at.empty() ? "" : fmt::format(" ({})", looked.at)));
    for (const std::string& why : looked.diagnose) print(fmt::format("  diagnose: {}\n", why));
    if (!looked.base.empty())
      print(fmt::format("  taken over from the base {}; write yours, or ± unknown\n", looked.base));
  }
  const std::string document = Json{{"schema", "mckibben-check/1"}, {"files", findings}}.dump(2) + "\n";
  std::vector<domain::InputFile> read;
  read.reserve(options.files.size());
  for (const auto& path : options.files) read.push_back({path, ""});
  Job job(options, "check", std::nullopt, read);
  job.write("check.json", document);
  const bool data = options.files.size() == 1 && !findings.front().value("looked_at", "").empty();
  return job.finish({document, ""}, status, data ? "replay " + options.files.front() : "");
}

/// docs/reference.md.
std::string reference_page() {
  std::vector<input::KindOfFile> kinds;
  for (Kind& kind : all_kinds()) kinds.push_back({std::move(kind.title), std::move(kind.fields)});
  return "# Every key\n\n"
         "Printed by `mckibben schema all --format markdown`: range and default of every key, by kind of "
         "file. "
         "Where a command is in mA, the unit is the valve's: V or bar in rigs that take these. "
         "[Scenarios](scenarios.md) and [Data sets](datasets.md) explain the files.\n\n" +
         input::field_lists(kinds) + output::table_of_signals();
}

struct SchemaOptions : Options {
  std::string kind = "scenario";  ///< scenario, campaign, rig, dataset, lever, pair, hypothesis, columns, all
  std::string format = "json";    ///< JSON Schema; markdown: a list; yaml: the rig `thesis`
};

int print_schema(const SchemaOptions& options) {
  const std::string &kind = options.kind, &format = options.format;
  if (format == "yaml" && kind != "rig") {
    say("--format yaml applies to `schema rig` only; `init` writes a scenario to start from");
    return usage_error;
  }
  if (format == "yaml") {
    print("# Keys of other valves, of effects and of pairs: mckibben schema rig --format markdown\n" +
          input::to_yaml(input::rig_json(plant::Rig{})));
    return done;
  }
  if (kind == "all") {
    if (format != "markdown") {
      say("schema all applies to --format markdown only: each kind of file has a JSON Schema of its own");
      return usage_error;
    }
    print(reference_page());
    return done;
  }
  if (kind == "columns") {
    print(format == "json" ? columns_json().dump(2) + "\n" : output::table_of_signals());
    return done;
  }
  const std::vector<Kind> all = all_kinds();
  const Kind& one = *std::ranges::find(all, kind, &Kind::name);
  print(format == "json" ? input::json_schema(one.schema, one.title, one.fields).dump(2) + "\n"
                         : input::field_lists({{one.title, one.fields}}));
  return done;
}

}  // namespace

void add_check(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(
      app, "check", to_find_out,
      "Validate scenario, campaign, rig, data set and hypothesis files; measured runs by a short simulation");
  CheckOptions& options = asked.when(verb, check_files);
  verb.add_option("files", options.files, "Files to check")->required()->type_name("FILE");
  verb.add_flag("--upgrade", options.upgrade,
                "Say only what is to be changed in files that were written for another version");
  add_common(verb, options, "nothing is written");
  verb.footer(
      "Examples:\n"
      "  mckibben check scenarios/*.yaml\n"
      "  mckibben check --upgrade old.yaml\n"
      "  mckibben check measured/ --json                  a data set and all of its files\n"
      "Every error of a file at once, each with file, line, column, value and rule.\n");
}

void add_schema(CLI::App& app, Asked& asked) {
  CLI::App& verb =
      add_verb(app, "schema", to_find_out, "Print the keys of a kind of file, as JSON Schema or as a list");
  SchemaOptions& options = asked.when(verb, print_schema);
  verb.add_option("kind", options.kind,
                  "Kind of file (default: scenario); columns: what tables have; all: the reference page")
      ->check(one_of("kind", {"scenario", "campaign", "rig", "dataset", "lever", "pair", "hypothesis",
                              "columns", "all"}))
      ->type_name("");
  CLI::Option* format = verb.add_option("--format", options.format,
                                        "How to print it (default: json); yaml, of a rig only, prints "
                                        "`thesis` with every value, to start from")
                            ->check(one_of("format", {"json", "markdown", "yaml"}))
                            ->type_name("");
  verb.add_flag("--json", options.json, "The same as --format json")->excludes(format);
  verb.footer(
      "Examples:\n"
      "  mckibben schema scenario --format markdown       every key with unit, default and range\n"
      "  mckibben schema rig --format yaml > my_rig.yaml  a rig to change\n"
      "  mckibben schema all --format markdown            docs/reference.md\n");
}

}  // namespace mckibben::cli
