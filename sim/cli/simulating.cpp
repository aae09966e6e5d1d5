// The verbs that simulate: run, replay. Each reads, computes, prints and writes.
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/cluster/share.hpp>
#include <sim/domain/number.hpp>
#include <sim/engine/versions.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/replay_results.hpp>
#include <sim/output/run_files.hpp>
#include <sim/output/run_results.hpp>
#include <sim/report/report.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/replay.hpp>
#include <sim/run/simulate.hpp>
#include <sim/tasks/tasks.hpp>

namespace mckibben::cli {
namespace {

constexpr double worth_telling_s = 0.05;  // a PID takes a thousandth of it

struct RunOptions : Options {
  std::string scenario;
  std::vector<std::string> formats;  ///< of runs, besides CSV
};

struct ReplayOptions : Options {
  std::string dataset;
  std::string rig;                   ///< replaces the data set's; empty for none
  std::vector<std::string> formats;  ///< of runs, besides CSV
};

/// Tables of runs as files in the formats asked for, and what their columns are.
class Tables {
 public:
  Tables(Job& job, std::string title, const std::vector<std::string>& formats)
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
  void close() { job_.write(output::package_file, output::datapackage(package_)); }

 private:
  Job& job_;
  const std::vector<std::string>& formats_;
  output::Package package_;
};

void write_tables(Job& job, const domain::Scenario& scenario, const run::Comparison& comparison,
                  const std::vector<std::string>& formats) {
  const bool pair = scenario.rig.pair() != nullptr;
  Tables tables(job, scenario.name, formats);
  for (const auto& run : comparison.runs) {
    if (run.recording.samples.empty()) continue;
    std::vector<formats::Attribute> attributes;
    output::Targets targets;
    if (run.followed()) {
      const run::Wanted& wanted = comparison.targets[run.target];
      targets = {{scenario.rig.has_angle() ? "angle" : "contraction_ratio", wanted.values},
                 {"stiffness", wanted.stiffness_N_m_per_rad}};
      attributes = {{"load_kg", run.load_kg}, {"controller", run.controller}};
    }
    attributes.emplace_back("seed", std::to_string(scenario.seed));
    const std::string title =
        pair ? run.name : fmt::format("{} kg, {}", domain::write_kg(run.load_kg), run.controller);
    tables.write(run.name, title, output::columns_of(run.recording, scenario.rig, targets),
                 std::move(attributes));
  }
  tables.close();
}

void write_tables(Job& job, const std::string& name, const domain::Dataset& dataset,
                  const std::vector<run::ReplayedRun>& runs, const std::vector<std::string>& formats) {
  Tables tables(job, "Replay of " + name, formats);
  for (const run::ReplayedRun& run : runs) {
    if (run.recording.samples.empty()) continue;
    std::vector<formats::Attribute> attributes;
    if (run.load_kg > 0.0) attributes.emplace_back("load_kg", run.load_kg);
    if (!dataset.own_clock) attributes.emplace_back("controller", "recorded current");
    const std::string title =
        run.load_kg > 0.0 ? fmt::format("{}, {} kg", run.id, domain::write_kg(run.load_kg)) : run.id;
    tables.write(run.id, title, output::columns_of(run.recording, dataset.rig), std::move(attributes));
  }
  tables.close();
}

/// What the bytes of a scenario's results depend on.
std::string key_of(const domain::Scenario& scenario) {
  std::string key = fmt::format("run, {}, SUNDIALS {}, seed {}", output::program_name(),
                                engine::sundials_version(), scenario.seed);
  for (const auto& file : scenario.inputs) key += ", " + file.sha256;
  return key;
}

/// With whoever else is at work there.
run::Comparison compare(const domain::Scenario& scenario, const RunOptions& options,
                        cluster::Workplace& place, const run::ProgressHook& progress) {
  const unsigned threads = cluster::threads_of(options.threads);
  if (!place.used()) return run::compare(scenario, threads, progress);
  return run::compare(
      scenario, threads, progress,
      [&](const std::string& stage, std::size_t count, bool for_all, const auto& job, const auto& take) {
        const auto needed = for_all ? cluster::Needed::by_all : cluster::Needed::by_rank_0;
        cluster::share(place, stage, count, threads, needed, job, take);
      });
}

/// How long tuning and planning took on this machine, on a terminal: results hold no such times, nor do logs.
void tell_times(const run::Comparison& comparison) {
  if (isatty(STDERR_FILENO) != 1) return;
  for (const auto& tuned : comparison.tuned)
    if (tuned.took_s > 0.0)
      fmt::print(stderr, "tuned {} in {:.2g} s ({} runs)\n", tuned.controller, tuned.took_s,
                 tuned.tuned.evaluations);
  for (const auto& spread : comparison.spreads) {
    double longest_s = 0.0, simulated_s = 0.0;
    for (const auto& run : comparison.runs)
      if (run.controller == spread.controller && run.recording.controller_s > longest_s) {
        longest_s = run.recording.controller_s;
        simulated_s = run.recording.samples.empty() ? 0.0 : run.recording.samples.back().time_s;
      }
    if (longest_s > worth_telling_s)
      fmt::print(stderr, "{} planned for {:.2g} s in its longest run of {:.3g} s\n", spread.controller,
                 longest_s, simulated_s);
  }
}

int run_scenario(const RunOptions& options) {
  const cluster::Crew& crew = cluster::crew();
  std::vector<input::Problem> problems;
  domain::Scenario scenario = input::read_scenario(std::filesystem::path(options.scenario), problems);
  for (const auto& problem : problems) fmt::print(stderr, "{}\n", to_text(problem));
  if (options.seed) scenario.seed = *options.seed;
  const auto ranks = destination(options, scenario.name).string() + ".ranks";
  keep_apart(ranks, scenario.inputs);
  cluster::Workplace place(ranks, crew, say);
  if (!crew.leads()) {
    place.begin(key_of(scenario));
    compare(scenario, options, place, [](const auto&, auto, auto) {});
    return done;
  }
  Job job(options, "run " + options.scenario, scenario.name, scenario.inputs);
  place.begin(key_of(scenario));
  run::Comparison comparison =
      with_progress(scenario.name, [&](const auto& hook) { return compare(scenario, options, place, hook); });
  if (!comparison.interrupted) place.close();
  tell_times(comparison);
  warn(comparison.warnings);
  std::vector<std::string> of_reader;  // said already
  of_reader.reserve(problems.size());
  for (const auto& problem : problems) of_reader.push_back(where(problem) + ": " + problem.message);
  comparison.warnings.insert(comparison.warnings.begin(), of_reader.begin(), of_reader.end());
  if (comparison.interrupted) job.interrupted(begun(comparison.runs), comparison.runs.size(), "runs");

  const std::string document = output::json_of(scenario, comparison);
  const std::string table = output::table_of(scenario, comparison);
  write_tables(job, scenario, comparison, options.formats);
  job.write("run.json", document);
  job.write("table.txt", table);
  if (!comparison.targets.empty()) job.write("tracking.svg", output::tracking_svg(scenario, comparison));
  job.write("loops.svg", output::loops_svg(scenario, comparison));
  job.write("report.html", report::report_html(scenario, comparison));
  const int status = job.finish({document, table}, any_failed(comparison.runs) ? failure
                                                   : !comparison.unmet.empty() ? criterion_not_met
                                                                               : done);
  if (!comparison.interrupted) place.leave();
  return status;
}

int replay_dataset(const ReplayOptions& options) {
  const domain::Dataset dataset = tasks::read_measured(options.dataset, options.rig, tasks::replace_rig);
  const std::string name = output::name_of(dataset);
  Job job(options, "replay " + options.dataset, name + "-replay", dataset.inputs);
  const auto first = tasks::asked_first(dataset);
  warn(first);
  const auto runs =
      with_progress(name, [&](const auto& hook) { return run::replay(dataset, options.threads, hook); });
  bool can_be_judged = false;
  const auto warnings = tasks::warnings_of(dataset, runs, &can_be_judged);
  auto others = warnings;
  std::erase_if(others, [&](const auto& one) { return std::ranges::find(first, one) != first.end(); });
  warn(others);
  if (begun(runs) < runs.size()) job.interrupted(begun(runs), runs.size(), "runs");

  const std::string document = output::json_of(dataset, runs, warnings);
  const std::string table = output::table_of(dataset, runs, warnings);
  write_tables(job, name, dataset, runs, options.formats);
  job.write("run.json", document);
  job.write("table.txt", table);
  job.write("report.html", report::report_html(dataset, runs, warnings));
  if (const std::string picture = report::tracking_svg(dataset, runs); !picture.empty())
    job.write("tracking.svg", picture);
  return job.finish({document, table}, any_failed(runs) ? failure : done,
                    options.rig.empty() && can_be_judged ? "diagnose " + options.dataset : "");
}

}  // namespace

void add_run(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(app, "run", to_simulate,
                            "Simulate each load x controller of a scenario; print tracking errors");
  RunOptions& options = asked.when(verb, run_scenario, Ranks::share);
  add_input(verb, options.scenario, "scenario", "Scenario file", "SCENARIO.yaml");
  add_common(verb, options);
  add_seed(verb, options, "the noise (default: the scenario's)");
  add_formats(verb, options.formats);
  verb.footer(
      "Examples:\n"
      "  mckibben run scenarios/five_loads.yaml\n"
      "  mckibben run my.yaml --out results --seed 2      somewhere else, with other noise\n"
      "  mckibben run my.yaml --json > result.json        for a script\n"
      "  mckibben run my.yaml --format mat,netcdf         also for MATLAB, Octave, Python\n"
      "Writes table.txt, run.json, report.html, tracking.svg, loops.svg and a CSV for each run.\n");
}

void add_replay(CLI::App& app, Asked& asked) {
  CLI::App& verb =
      add_verb(app, "replay", to_compare, "Simulate a data set's runs with their recorded currents; compare");
  ReplayOptions& options = asked.when(verb, replay_dataset);
  add_measured(verb, options.dataset);
  add_common(verb, options, "out/<name>-replay");
  add_rig(verb, options.rig, "instead of the data set's");
  add_formats(verb, options.formats);
  verb.footer(
      "Examples:\n"
      "  mckibben replay measured/\n"
      "  mckibben replay labview.yaml --format mat        .lvm and .mat in, .mat out: docs/formats.md\n"
      "  mckibben replay measured/ --rig my_rig.yaml --out compared\n"
      "Writes table.txt, run.json, report.html, tracking.svg and the simulation of each run as CSV.\n");
}

}  // namespace mckibben::cli
