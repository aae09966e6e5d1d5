// Each reads, computes, prints and writes; see the header.
#include <fmt/format.h>

#include <sim/cli/driven.hpp>
#include <sim/cli/exit_status.hpp>
#include <sim/cli/results.hpp>
#include <sim/domain/number.hpp>
#include <sim/input/pair_scenario_file.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/driven_csv.hpp>
#include <sim/output/driven_results.hpp>
#include <sim/output/run_files.hpp>
#include <sim/report/report.hpp>
#include <sim/run/warnings.hpp>

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
    if (package_.columns.empty()) package_.columns = columns;
    const formats::Table table{package_.title + ": " + title, std::move(columns), std::move(attributes)};
    for (const auto& file : output::run_files(stem, table, formats_)) job_.write(file.name, file.content);
    package_.runs.push_back({stem, title});
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
template <class What, class Runs>
int finish(Job& job, const What& what, const Runs& runs, const std::vector<std::string>& warnings) {
  warn(warnings);
  const bool interrupted = begun(runs) < runs.size();
  if (interrupted) job.interrupted(begun(runs), runs.size(), "runs");
  input::Json json = output::json_of(what, runs, warnings);
  if (interrupted) json["interrupted"] = true;
  const std::string document = json.dump(2) + "\n", table = output::table_of(what, runs, warnings);
  job.write("run.json", document);
  job.write("table.txt", table);
  job.write("report.html", report::report_html(what, runs, warnings));
  return job.finish({document, table}, any_failed(runs) ? failure : done);
}

}  // namespace

int run_pair(const Options& options, const std::string& path, const std::vector<std::string>& formats) {
  const domain::PairScenario scenario = input::read_pair_scenario(std::filesystem::path(path));
  Job job(options, "run " + path, scenario.name, scenario.inputs);
  const std::vector<run::PairRun> runs = with_progress(
      scenario.name, [&](const auto& hook) { return run::run_pairs(scenario, options.threads, hook); });
  TablesOf tables(job, scenario.name, formats);
  for (const auto& run : runs)
    if (!run.recording.samples.empty())
      tables.write(run.name, run.name, output::driven_columns(run.recording, scenario.rig, false), {});
  tables.close();
  return finish(job, scenario, runs, run::warnings_of(runs));
}

int replay_stamped(const Options& options, const std::string& path, const domain::Dataset& dataset,
                   const std::vector<std::string>& formats) {
  const std::string name = output::name_of(dataset);
  Job job(options, "replay " + path, name + "-replay", dataset.inputs);
  const std::vector<run::StampedRun> runs = with_progress(
      name, [&](const auto& hook) { return run::replay_stamped(dataset, options.threads, hook); });
  std::vector<std::string> warnings;
  TablesOf tables(job, "Replay of " + name, formats);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const run::StampedRun& run = runs[i];
    for (const auto& doubt : run::doubts(run.recording))
      warnings.push_back(run::warning_of_run(run.id, doubt));
    if (run.recording.samples.empty()) continue;
    std::vector<formats::Attribute> attributes;
    if (run.load_kg > 0.0) attributes.emplace_back("load_kg", run.load_kg);
    tables.write(
        run.id, run.id,
        output::driven_columns(run.recording, dataset.rig, !dataset.runs[i].measured->force_N.empty()),
        std::move(attributes));
  }
  tables.close();
  return finish(job, dataset, runs, run::grouped(warnings));
}

}  // namespace mckibben::cli
