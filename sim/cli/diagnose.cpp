// The verb `diagnose`: what a rig lacks, found in measured runs.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/diagnose/diagnosis.hpp>
#include <sim/engine/failure.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/finding_places.hpp>
#include <sim/output/diagnosis_results.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/report/report.hpp>
#include <sim/run/batch.hpp>
#include <sim/tasks/kept_search.hpp>
#include <sim/tasks/tasks.hpp>

namespace mckibben::cli {
namespace {

/// Throws output::CannotWrite if another file than an earlier plan stands there.
void check_plan(const std::string& plan) {
  std::error_code error;
  const bool there = !plan.empty() && std::filesystem::exists(plan, error);
  if (error) throw output::CannotWrite(fmt::format("cannot write {}: {}", plan, error.message()));
  if (!there) return;
  const auto found = output::read_regular(plan);
  if (!found || !found->starts_with(output::plan_heading))
    throw output::CannotWrite(
        fmt::format("cannot write {}: what is there is not an earlier plan; give another --plan", plan));
}

void write_plan(const std::string& plan, const domain::Dataset& data, const diagnose::Diagnosis& found) {
  if (plan.empty()) return;
  if (!found.next_experiment) {
    const std::string instead = output::what_next(found);
    fmt::print(stderr, "mckibben: no plan written. {}\n",
               instead.empty() ? "No two models are left that a measurement could distinguish." : instead);
    return;
  }
  output::write_whole(std::filesystem::absolute(plan), output::plan_yaml(data, found));
  fmt::print(stderr, "plan in {}\n", plan);
}

/// What is to be written in the data set first, or a replay shows the fault again; empty if nothing is.
std::string what_mends(const domain::Dataset& data, const diagnose::Diagnosis& found) {
  std::vector<std::string> lines;
  for (const diagnose::BenchFault& fault : found.bench) {
    if (!fault.can_be_written() || fault.size.holds(0.0)) continue;
    const auto run = std::ranges::find(data.runs, fault.runs.front(), &domain::Run::id);
    if (!fault.of_loads() || fault.runs.size() != 1 || data.parts_of_a_run)
      return fmt::format("write in {} what the table has, for the runs that it names", data.path.string());
    const auto index = static_cast<std::size_t>(run - data.runs.begin());
    const auto at =
        input::problems_of(data.path, {{.quantity = "load", .runs = {index}, .message = ""}}).front().place;
    lines.push_back(fmt::format("{} in line {}", fault.write, at.line));
  }
  if (lines.empty()) return "";
  return fmt::format("write in {} {}", data.path.string(), fmt::join(lines, ", "));
}

struct DiagnoseOptions : Options {
  std::string dataset;
  std::string rig;                      ///< replaces the data set's; empty for none
  std::vector<std::string> hypotheses;  ///< files of laws that join the catalogue
  std::string plan;  ///< where to write the next experiment as a campaign; empty for nowhere
  double time_limit_s = std::numeric_limits<double>::infinity();
  std::string resume;  ///< folder of a diagnosis that was ended; empty for none
};

int diagnose_dataset(const DiagnoseOptions& options) {
  domain::Dataset data = tasks::read_measured(options.dataset, options.rig, input::take_rig);
  const tasks::Prepared prepared = tasks::prepare(data, options.hypotheses, warn);
  const std::string name = output::name_of(data);
  check_plan(options.plan);
  identify::Simulated known;
  if (!options.resume.empty())
    known = tasks::simulated_in(std::filesystem::path(options.resume) / tasks::kept_search, data.inputs);
  Job job(options, "diagnose " + options.dataset, name + "-diagnose", data.inputs);
  tasks::Found found;
  try {
    const tasks::Diagnosing how{options.threads, options.seed.value_or(1), options.time_limit_s, prepared,
                                &known};
    found = with_progress(name, [&](const auto& hook) { return tasks::find(data, how, hook); });
  } catch (const engine::NumericalFailure& error) {
    say(fmt::format("the data cannot be simulated on this rig: {}", error.what()));
    return failure;
  }
  const diagnose::Diagnosis& diagnosis = found.diagnosis;
  if (diagnosis.ended == diagnose::Ended::by_user) job.interrupted("what was found by then");
  const std::string document = output::json_of(data, diagnosis);
  job.write("diagnosis.json", document);
  job.write("rig.yaml", output::rig_yaml(data, diagnosis));
  if (diagnosis.ended != diagnose::Ended::no)
    job.write(tasks::kept_search, tasks::bytes_of(found.simulated, data.inputs));
  if (!diagnosis.residual_law.empty()) job.write("law.yaml", output::law_yaml(data, diagnosis));
  job.write("report.html", report::report_html(data, diagnosis, found.nominal, found.corrected));
  if (const std::string picture = report::before_after_svg(data, diagnosis, found.nominal, found.corrected);
      !picture.empty())
    job.write("before_after.svg", picture);
  const auto file = [&](const char* leaf) { return (job.where() / leaf).string(); };
  const std::string law = diagnosis.residual_law.empty() ? "" : fmt::format("law    {}\n", file("law.yaml"));
  const std::string files = fmt::format("\nreport {}\nrig    {}\n{}all    {}\n", file("report.html"),
                                        file("rig.yaml"), law, file("diagnosis.json"));
  const std::string go_on = diagnosis.ended == diagnose::Ended::no || !job.has_folder()
                                ? ""
                                : fmt::format("\nTo go on from here:\n  mckibben diagnose {} --resume {}\n",
                                              options.dataset, job.where().string());
  const int status = job.finish({document, output::table_of(data, diagnosis) + files + go_on}, done,
                                job.has_folder() && diagnosis.ended == diagnose::Ended::no
                                    ? fmt::format("replay {} --rig {}", options.dataset, file("rig.yaml"))
                                    : "",
                                what_mends(data, diagnosis));
  write_plan(options.plan, data, diagnosis);
  return status;
}

}  // namespace

void add_diagnose(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(
      app, "diagnose", to_compare,
      "Find where model and data disagree; name the missing effect, add it, show the error before and after");
  DiagnoseOptions& options = asked.when(verb, diagnose_dataset);
  add_measured(verb, options.dataset);
  add_common(verb, options, "out/<name>-diagnose");
  add_rig(verb, options.rig, "instead of the data set's");
  add_hypotheses_option(verb, options.hypotheses, "join the catalogue");
  add_seed(verb, options, "the resampling (default: 1)");
  verb.add_option("--plan", options.plan, "Write the most useful next measurement, if any, as a campaign")
      ->type_name("FILE");
  add_quantity(
      verb, "--time-limit", options.time_limit_s, "s", 1e6,
      "End the search then, with the best so far (default: when it is through); Ctrl-C ends it as well",
      "TIME");
  verb.add_option("--resume", options.resume,
                  "Go on with the search of a diagnosis that was ended, from its folder")
      ->type_name("FOLDER");
  verb.footer(
      "Examples:\n"
      "  mckibben diagnose measured/\n"
      "  mckibben diagnose measured/ --time-limit '20 min'\n"
      "  mckibben diagnose measured/ --resume out/measured-diagnose\n"
      "  mckibben diagnose measured/ --out diagnosis --plan next.yaml\n"
      "  mckibben diagnose measured/ --hypothesis my_law.yaml\n"
      "Writes report.html (to read), before_after.svg (its first picture), rig.yaml (the corrected rig, for "
      "run and replay) and diagnosis.json;\n"
      "law.yaml if it found a law that no effect of the catalogue has, to be put to the test with "
      "--hypothesis.\n");
}

}  // namespace mckibben::cli
