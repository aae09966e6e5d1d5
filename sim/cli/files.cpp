// The verbs about files: check, schema.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include <sim/cli/exit_status.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/calibration_file.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/field_table.hpp>
#include <sim/input/json_schema.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/input/suggest.hpp>
#include <sim/input/utf8.hpp>
#include <sim/input/yaml_file.hpp>
#include <sim/input/yaml_writer.hpp>
#include <sim/output/folder.hpp>
#include <sim/run/sanity.hpp>

namespace mckibben::cli {
namespace {

using input::Json;
using input::Problem;

/// Reads a data set and looks at what it says; adds warnings. Throws what is wrong with it. Returns what was
/// looked at.
std::string read_measured(const std::filesystem::path& path, std::vector<Problem>& warnings) {
  const domain::Dataset data = input::read_dataset(path);
  const run::Look look = run::look(data);
  run::raise(data, look.findings);
  warnings = run::problems_of(data, look.findings);
  return fmt::format("{} of {} runs simulated: stroke, sign, units, order of loads", look.runs,
                     data.runs.size());
}

/// Reads a file as what its `schema:` says it is; adds warnings. Throws what is wrong with it. Returns what
/// was looked at besides.
std::string read_any(const std::filesystem::path& path, std::vector<Problem>& warnings) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return read_measured(path, warnings);
  const input::YamlFile file = input::load_yaml(path);
  const input::Node* schema = file.root.find("schema");
  const std::string kind = schema == nullptr ? "" : schema->text.substr(0, schema->text.find('/'));
  if (kind == "mckibben-rig") {
    std::vector<domain::InputFile> inputs;
    input::read_rig(path.string(), inputs);
  } else if (kind == "mckibben-dataset") {
    return read_measured(path, warnings);
  } else if (kind == "mckibben-campaign") {
    input::read_campaign(path);
  } else if (kind == "mckibben-calibration") {
    std::vector<domain::InputFile> inputs;
    input::read_calibration(path, inputs);
  } else if (kind == "mckibben-scenario") {
    input::read_scenario(path, warnings);
  } else {
    constexpr std::string_view known[] = {input::scenario_schema, input::campaign_schema, input::rig_schema,
                                          input::dataset_schema, input::calibration_schema};
    input::Problems problems;
    if (schema == nullptr)
      problems.error(file.source, file.root.place,
                     fmt::format("the file must say what it is: schema: one of {}", input::join(known)));
    else
      problems.error(file.source, schema->place,
                     fmt::format("unknown schema {}{} (known: {})", input::shortened(schema->text),
                                 input::did_you_mean(schema->text, known), input::join(known)));
    problems.raise();
  }
  return "";
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

template <class Schema>
int print_kind(std::string_view schema, const char* title, const Schema& fields, const std::string& format) {
  if (format == "json")
    print(input::json_schema(schema, title, fields).dump(2) + "\n");
  else
    print(input::field_table(title, fields));
  return done;
}

}  // namespace

int check_files(const std::vector<std::string>& paths, const Options& options) {
  int status = done;
  Json findings = Json::array();
  for (const auto& path : paths) {
    std::vector<Problem> found;
    int file_status = done;
    std::string missing, looked;
    try {
      looked = read_any(path, found);
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
      fmt::print(stderr, "{}\n", to_text(problem));
    }
    if (!missing.empty()) {
      entry["problems"].push_back({{"file", path}, {"severity", "error"}, {"message", missing}});
      fmt::print(stderr, "mckibben: {}\n", missing);
    }
    if (!looked.empty()) entry["looked_at"] = looked;
    findings.push_back(std::move(entry));
    if (file_status == done && !options.json)
      print(fmt::format("{}: ok{}\n", path, looked.empty() ? "" : fmt::format(" ({})", looked)));
  }
  const std::string document = Json{{"schema", "mckibben-check/1"}, {"files", findings}}.dump(2) + "\n";
  if (!options.out.empty()) {
    std::vector<domain::InputFile> read;
    read.reserve(paths.size());
    for (const auto& path : paths) read.push_back({path, ""});
    keep_apart(options.out, read);
    output::ResultFolder folder(options.out, "check", say);
    folder.write("check.json", document);
    folder.publish();
  }
  if (options.json) print(document);
  return status;
}

int print_schema(const std::string& kind, const std::string& format) {
  if (format == "yaml") {
    print(input::to_yaml(input::rig_json(domain::RigFile{})));
    return done;
  }
  if (kind == "rig")
    return print_kind(input::rig_schema, "Rig", input::list_fields<domain::RigFile>(), format);
  if (kind == "campaign")
    return print_kind(input::campaign_schema, "Campaign", input::list_fields<domain::Campaign>(), format);
  if (kind == "dataset")
    return print_kind(input::dataset_schema, "Data set", input::list_fields<domain::Dataset>(), format);
  return print_kind(input::scenario_schema, "Scenario", input::list_fields<domain::Scenario>(), format);
}

}  // namespace mckibben::cli
