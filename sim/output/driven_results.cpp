// Layout; see the header.
#include <algorithm>

#include <fmt/format.h>

#include <sim/input/rigs.hpp>
#include <sim/output/driven_results.hpp>
#include <sim/output/grid.hpp>
#include <sim/output/json_parts.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::output {
namespace {

using input::Json;

/// What is told of every ride that came to its end.
void put_ride(Json& entry, const plant::Rig& rig, const run::Recording& recording) {
  entry["slack"] = slack_json(recording);
  entry["largest_contraction_ratio"] = recording.largest_contraction_ratio;
  entry["ledger"] = ledger_json(rig, recording);
  if (recording.driven.length) entry["ledger"]["bench_work_J"] = recording.ledger.bench_work_J;
  entry["solver"] = solver_json(recording.solver);
}

template <class Runs>
std::string without_result(const Runs& runs, const std::vector<std::string>& warnings) {
  std::string failures, warned;
  for (const auto& run : runs)
    if (!run.failure.empty()) failures += fmt::format("  {}: {}\n", run.id, run.failure);
  for (const auto& text : warnings) warned += fmt::format("  {}\n", text);
  return section("no result", failures) + section("warnings", warned);
}

}  // namespace

std::string json_of(const domain::Dataset& dataset, const std::vector<run::StampedRun>& runs,
                    const std::vector<std::string>& warnings) {
  Json document = heading_json("mckibben-stamped-replay/1", dataset.inputs);
  document["report"] = "report.html";
  document["tolerance"] = dataset.rig.integrator.tolerance;
  document["rig"] = input::rig_json(dataset.rig);
  document["runs"] = Json::array();
  for (const auto& run : runs) {
    Json entry{{"id", run.id}};
    if (run.load_kg > 0.0) entry["load_kg"] = run.load_kg;
    if (!run.recording.samples.empty()) entry["file"] = run.id + ".csv";
    if (!run.failure.empty()) {
      entry["failure"] = run.failure;
    } else {
      entry["gaps"] = Json::array();
      for (const run::Gap& gap : run.gaps)
        entry["gaps"].push_back({{"reading", gap.reading},
                                 {"unit", gap.unit},
                                 {"rows", gap.rows},
                                 {"rmse", gap.rmse},
                                 {"largest_error", gap.largest},
                                 {"mean_error", gap.mean}});
      put_ride(entry, dataset.rig, run.recording);
    }
    document["runs"].push_back(std::move(entry));
  }
  document["warnings"] = warnings;
  if (std::any_of(runs.begin(), runs.end(), [](const auto& run) { return run.failure == run::not_begun; }))
    document["interrupted"] = true;
  return text_of(document);
}

std::string gap_number(double value, bool sign) {
  return sign ? fmt::format("{:+.4g}", value) : fmt::format("{:.4g}", value);
}

std::string table_of(const domain::Dataset& dataset, const std::vector<run::StampedRun>& runs,
                     const std::vector<std::string>& warnings) {
  Grid grid({"run", "reading", "unit", "rmse", "largest", "mean", "rows"}, 3);
  for (const auto& run : runs) {
    if (!run.failure.empty())
      grid.add({run.id, "no result", "", "-", "-", "-", "-"});
    else if (run.gaps.empty())
      grid.add({run.id, "none", "", "-", "-", "-", "-"});
    for (const run::Gap& gap : run.gaps) {
      const bool height = is_height(gap);
      const double factor = height ? 1e3 * dataset.rig.muscle.rest_length_m : 1.0;
      grid.add({run.id, gap.reading, height ? "mm" : gap.unit, gap_number(factor * gap.rmse),
                gap_number(factor * gap.largest), gap_number(factor * gap.mean, true),
                std::to_string(gap.rows)});
    }
  }
  return fmt::format("{}: {} run{} replayed; simulated less measured, of each reading\n\n",
                     dataset.path.string(), runs.size(), runs.size() == 1 ? "" : "s") +
         grid.text() + without_result(runs, warnings);
}

}  // namespace mckibben::output
