// The verb `diagnose`: what a rig lacks, found in measured runs.
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/cli/exit_status.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/diagnose/diagnose.hpp>
#include <sim/engine/failure.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/rigs.hpp>
#include <sim/output/diagnosis_json.hpp>
#include <sim/output/diagnosis_rig.hpp>
#include <sim/output/diagnosis_table.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/progress.hpp>
#include <sim/report/report.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/replay.hpp>

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
    fmt::print(stderr, "mckibben: no plan is written: no measurement of the menu is asked for{}{}\n",
               instead.empty() ? "" : ". ", instead);
    return;
  }
  output::write_whole(std::filesystem::absolute(plan), output::plan_yaml(data, found));
  fmt::print(stderr, "plan in {}\n", plan);
}

}  // namespace

int diagnose_dataset(const std::string& path, const Options& options, const std::string& plan) {
  domain::Dataset data = input::read_dataset(path);
  if (!options.rig.empty()) data.rig = input::read_rig(options.rig, data.inputs);
  const std::string name = output::name_of(data);
  const auto where = destination(options, "diagnose-" + name);
  keep_apart(where, data.inputs);
  check_plan(plan);
  output::ResultFolder folder(where, "diagnose " + path, say);

  diagnose::Diagnosis found;
  std::vector<std::string> known;                    // so far
  std::vector<run::ReplayedRun> nominal, corrected;  // for pressures and forces
  try {
    output::Progress progress(name);
    const diagnose::Settings settings{options.threads, options.seed.value_or(1),
                                      [&](const std::string& what) { known.push_back(what); }};
    found = diagnose::diagnose(data, settings, progress.hook());
    nominal = run::replay(data, options.threads, progress.hook());
    domain::Dataset mended = data;
    mended.rig = found.corrected;
    corrected = run::replay(mended, options.threads, progress.hook());
  } catch (const run::Interrupted&) {
    if (!known.empty()) fmt::print(stderr, "known so far:\n  {}\n", fmt::join(known, "\n  "));
    throw;
  } catch (const engine::NumericalFailure& error) {
    fmt::print(stderr, "mckibben: the data cannot be simulated on this rig: {}\n", error.what());
    return failure;
  }
  const std::string document = output::json_of(data, found).dump(2) + "\n";
  folder.write("diagnosis.json", document);
  folder.write("rig.yaml", output::rig_yaml(data, found));
  folder.write("report.html", report::report_html(data, found, nominal, corrected));
  publish(folder, where);
  write_plan(plan, data, found);
  const auto file = [&](const char* leaf) { return (where / leaf).string(); };
  print(options.json ? document
                     : output::table_of(data, found) + fmt::format("\nreport {}\nrig    {}\nall    {}\n",
                                                                   file("report.html"), file("rig.yaml"),
                                                                   file("diagnosis.json")));
  return done;
}

}  // namespace mckibben::cli
