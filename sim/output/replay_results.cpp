// Layout; see the header.
#include <algorithm>

#include <fmt/format.h>

#include <sim/input/rigs.hpp>
#include <sim/output/grid.hpp>
#include <sim/output/json_parts.hpp>
#include <sim/output/replay_results.hpp>
#include <sim/output/run_results.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::output {
namespace {

using input::Json;

Json gap_json(const run::Gap& gap) {
  return {{"reading", gap.reading},       {"unit", gap.unit},      {"rows", gap.rows}, {"rmse", gap.rmse},
          {"largest_error", gap.largest}, {"mean_error", gap.mean}};
}

std::string without_result(const std::vector<run::ReplayedRun>& runs,
                           const std::vector<std::string>& warnings) {
  std::string failures, warned;
  for (const auto& run : runs)
    if (!run.failure.empty()) failures += fmt::format("  {}: {}\n", run.id, run.failure);
  for (const auto& text : warnings) warned += fmt::format("  {}\n", text);
  return section("no result", failures) + section("warnings", warned);
}

}  // namespace

std::string json_of(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs,
                    const std::vector<std::string>& warnings) {
  Json document = heading_json("mckibben-replay/1", dataset.inputs);
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
      if (const run::Gap* height = run.gap("contraction")) {
        entry["rmse"] = height->rmse;
        entry["largest_error"] = height->largest;
        entry["mean_error"] = height->mean;
        const run::Gap* pressure = run.gap("muscle_pressure");
        entry["pressure_rmse_bar"] = pressure != nullptr ? Json(pressure->rmse) : Json(nullptr);
      }
      entry["gaps"] = Json::array();
      for (const run::Gap& gap : run.gaps) entry["gaps"].push_back(gap_json(gap));
      entry["contraction"] = contraction_json(dataset.rig, run.recording);
      entry["slack"] = run.recording.slack;
      entry["ledger"] = ledger_json(dataset.rig, run.recording);
      if (run.recording.driven.length || run.recording.driven.joint_force)
        entry["ledger"]["bench_work_J"] = run.recording.ledger.bench_work_J;
      entry["solver"] = solver_json(run.recording.solver);
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

std::string table_of(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs,
                     const std::vector<std::string>& warnings) {
  Grid grid({"run", "reading", "unit", "rmse", "largest", "mean", "rows"}, 3);
  std::string notes;
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
    if (run.failure.empty() && !run.recording.driven.pair && !run.recording.driven.length)
      notes += contraction_note(dataset.rig, run.recording.largest_contraction_ratio, run.id);
  }
  return fmt::format("{}: {} run{} replayed; simulated less measured, of each reading\n\n",
                     dataset.path.string(), runs.size(), runs.size() == 1 ? "" : "s") +
         grid.text() + section("contraction", notes) + without_result(runs, warnings);
}

}  // namespace mckibben::output
