// Each reads, computes, prints and writes; see the header.
#include <fmt/format.h>

#include <sim/cli/driven.hpp>
#include <sim/cli/exit_status.hpp>
#include <sim/cli/results.hpp>
#include <sim/domain/number.hpp>
#include <sim/input/pair_scenario_file.hpp>
#include <sim/output/csv.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/driven_results.hpp>
#include <sim/output/run_files.hpp>
#include <sim/report/report.hpp>
#include <sim/tasks/replay.hpp>

namespace mckibben::cli {
namespace {

/// The tables of runs, and what their columns are.
class TablesOf {
 public:
  TablesOf(Job& job, std::string title, const std::vector<std::string>& formats)
      : job_(job), formats_(formats), package_{std::move(title), {}, {}} {}

  void write(const std::string& stem, const std::string& title, std::vector<formats::Column> columns,
             std::vector<formats::Attribute> attributes) {
    attributes.insert(attributes.begin(), {"source", output::program_name()});
    std::vector<formats::Column> heads;
    heads.reserve(columns.size());
    for (const auto& column : columns) heads.push_back({column.name, column.unit, column.meaning, {}});
    const formats::Table table{package_.title + ": " + title, std::move(columns), std::move(attributes)};
    for (const auto& file : output::run_files(stem, table, formats_)) job_.write(file.name, file.content);
    package_.runs.push_back({stem, title, std::move(heads)});
  }
  void close() {
    if (!package_.runs.empty()) job_.write(output::package_file, output::datapackage(package_));
  }

 private:
  Job& job_;
  const std::vector<std::string>& formats_;
  output::Package package_;
};

/// Writes what is the same of both, and ends the job.
template <class What, class Result, class Runs>
int finish(Job& job, const What& what, const Result& result, const Runs& runs,
           const std::vector<std::string>& warnings) {
  warn(warnings);
  const bool interrupted = begun(runs) < runs.size();
  if (interrupted) job.interrupted(begun(runs), runs.size(), "runs");
  const std::string document = output::json_of(what, result, warnings, interrupted),
                    table = output::table_of(what, result, warnings);
  job.write("run.json", document);
  job.write("table.txt", table);
  job.write("report.html", report::report_html(what, result, warnings));
  return job.finish({document, table}, any_failed(runs) ? failure : done);
}

}  // namespace

int run_pair(const Options& options, const std::string& path, const std::vector<std::string>& formats) {
  const domain::PairScenario scenario = input::read_pair_scenario(std::filesystem::path(path));
  Job job(options, "run " + path, scenario.name, scenario.inputs);
  const run::PairRuns all = with_progress(
      scenario.name, [&](const auto& hook) { return run::run_pairs(scenario, options.threads, hook); });
  TablesOf tables(job, scenario.name, formats);
  for (const auto& run : all.runs) {
    if (run.recording.samples.empty()) continue;
    output::Targets targets;
    if (run.followed)
      targets = {{"angle", run.followed->angle_rad}, {"stiffness", run.followed->stiffness_N_m_per_rad}};
    tables.write(run.name, run.name, output::columns_of(run.recording, scenario.rig, targets), {});
  }
  tables.close();
  return finish(job, scenario, all, all.runs, run::warnings_of(all.runs));
}

int replay_stamped(const Options& options, const std::string& path, const domain::Dataset& dataset,
                   const std::vector<std::string>& formats) {
  const std::string name = output::name_of(dataset);
  Job job(options, "replay " + path, name + "-replay", dataset.inputs);
  const std::vector<run::StampedRun> runs = with_progress(
      name, [&](const auto& hook) { return run::replay_stamped(dataset, options.threads, hook); });
  const auto warnings = tasks::warnings_of(dataset, runs);
  TablesOf tables(job, "Replay of " + name, formats);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const run::StampedRun& run = runs[i];
    if (run.recording.samples.empty()) continue;
    std::vector<formats::Attribute> attributes;
    if (run.load_kg > 0.0) attributes.emplace_back("load_kg", run.load_kg);
    tables.write(run.id, run.id, output::columns_of(run.recording, dataset.rig), std::move(attributes));
  }
  tables.close();
  return finish(job, dataset, runs, runs, warnings);
}

}  // namespace mckibben::cli
