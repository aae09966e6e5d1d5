// The verbs that simulate: run, replay. Each reads, computes, prints and writes.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include <sim/cli/exit_status.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/domain/number.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/output/csv.hpp>
#include <sim/output/folder.hpp>
#include <sim/output/plot.hpp>
#include <sim/output/progress.hpp>
#include <sim/output/run_files.hpp>
#include <sim/output/run_json.hpp>
#include <sim/output/table.hpp>
#include <sim/report/report.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/replay.hpp>
#include <sim/run/sanity.hpp>
#include <sim/run/simulate.hpp>
#include <sim/run/warnings.hpp>

namespace mckibben::cli {
namespace {

template <class Run>
std::size_t begun(const std::vector<Run>& runs) {
  return static_cast<std::size_t>(
      std::count_if(runs.begin(), runs.end(), [](const auto& run) { return run.failure != run::not_begun; }));
}

void write_run(output::ResultFolder& folder, output::Package& package, const std::string& stem,
               const std::string& title, const formats::Table& table, const Options& options) {
  for (const auto& file : output::run_files(stem, table, options.formats))
    folder.write(file.name, file.content);
  package.runs.push_back({stem, title});
}

/// What looks wrong in the data, and what is doubtful in their simulation. Throws input::BadInput where a
/// comparison with them would mean nothing.
std::vector<std::string> sane(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs) {
  const auto findings = run::sanity(dataset, run::expected_of(runs));
  run::raise(dataset, findings);
  std::vector<std::string> warnings;
  warnings.reserve(findings.size());
  for (const auto& finding : findings) warnings.push_back(run::text_of(dataset, finding));
  for (const auto& run : runs)
    for (const auto& doubt : run::doubts(run.recording))
      warnings.push_back(run::warning_of_run(run.id, doubt));
  return warnings;
}

}  // namespace

int run_scenario(const std::string& path, const Options& options) {
  std::vector<input::Problem> warnings;
  domain::Scenario scenario = input::read_scenario(std::filesystem::path(path), warnings);
  for (const auto& warning : warnings) fmt::print(stderr, "{}\n", to_text(warning));
  if (options.seed) scenario.seed = *options.seed;
  const auto where = destination(options, scenario.name);
  keep_apart(where, scenario.inputs);
  output::ResultFolder folder(where, "run " + path, say);

  run::Comparison comparison;
  {
    output::Progress progress(scenario.name);
    comparison = run::compare(scenario, options.threads, progress.hook());
  }
  warn(comparison.warnings);
  const auto place = comparison.interrupted ? beside(where) : where;
  if (comparison.interrupted) folder.go_to(place);
  const double per_count = run::contraction_per_count(scenario.rig);
  const bool gauge = scenario.rig.gauge.fitted;
  output::Package package{scenario.name, output::recorded_columns(true, gauge), {}};
  for (const auto& run : comparison.runs) {
    if (run.recording.samples.empty()) continue;
    const std::string title = fmt::format("{} kg, {}", domain::write_number(run.load_kg), run.controller);
    write_run(folder, package, output::file_stem(run), title,
              {scenario.name + ": " + title,
               output::columns_of(run.recording, per_count, comparison.target, gauge),
               {{"source", output::program_name()},
                {"load_kg", run.load_kg},
                {"controller", run.controller},
                {"seed", std::to_string(scenario.seed)}}},
              options);
  }
  folder.write(output::package_file, output::datapackage(package));
  const std::string document = output::json_of(scenario, comparison).dump(2) + "\n";
  const std::string table = output::table_of(scenario, comparison);
  folder.write("run.json", document);
  folder.write("table.txt", table);
  folder.write("tracking.svg", output::tracking_svg(scenario, comparison));
  folder.write("report.html", report::report_html(scenario, comparison));
  publish(folder, place);
  print(options.json ? document : table);
  if (comparison.interrupted) {
    say_interrupted(begun(comparison.runs), comparison.runs.size(), "runs", where);
    return interrupted;
  }
  if (std::any_of(comparison.runs.begin(), comparison.runs.end(),
                  [](const auto& run) { return !run.failure.empty(); }))
    return failure;
  return comparison.unmet.empty() ? done : criterion_not_met;
}

int replay_dataset(const std::string& path, const Options& options) {
  domain::Dataset dataset = input::read_dataset(path);
  if (!options.rig.empty()) dataset.rig = input::read_rig(options.rig, dataset.inputs);
  const auto home = std::filesystem::absolute(dataset.path).lexically_normal().parent_path();
  const std::string name = home.has_filename() ? home.filename().string() : "dataset";
  const auto where = destination(options, name + "-replay");
  keep_apart(where, dataset.inputs);
  output::ResultFolder folder(where, "replay " + path, say);

  std::vector<run::ReplayedRun> runs;
  {
    output::Progress progress(name);
    runs = run::replay(dataset, options.threads, progress.hook());
  }
  const bool stopped = begun(runs) < runs.size();
  const auto warnings = sane(dataset, runs);
  warn(warnings);
  const auto place = stopped ? beside(where) : where;
  if (stopped) folder.go_to(place);
  const double per_count = run::contraction_per_count(dataset.rig);
  const bool gauge = dataset.rig.gauge.fitted;
  output::Package package{"Replay of " + name, output::recorded_columns(false, gauge), {}};
  for (const auto& run : runs) {
    if (run.recording.samples.empty()) continue;
    const std::string title = fmt::format("{}, {} kg", run.id, domain::write_number(run.load_kg));
    write_run(
        folder, package, run.id, title,
        {package.title + ": " + title,
         output::columns_of(run.recording, per_count, {}, gauge),
         {{"source", output::program_name()}, {"load_kg", run.load_kg}, {"controller", "recorded current"}}},
        options);
  }
  folder.write(output::package_file, output::datapackage(package));
  input::Json json = output::json_of(dataset, runs);
  json["warnings"] = warnings;
  if (stopped) json["interrupted"] = true;
  const std::string document = json.dump(2) + "\n";
  const std::string table = output::table_of(dataset, runs);
  folder.write("run.json", document);
  folder.write("table.txt", table);
  folder.write("report.html", report::report_html(dataset, runs, warnings));
  publish(folder, place);
  print(options.json ? document : table);
  if (stopped) {
    say_interrupted(begun(runs), runs.size(), "runs", where);
    return interrupted;
  }
  const bool failed =
      std::any_of(runs.begin(), runs.end(), [](const auto& run) { return !run.failure.empty(); });
  return failed ? failure : done;
}

}  // namespace mckibben::cli
