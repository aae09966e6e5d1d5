// Layout of both; see the header.
#include <fmt/format.h>

#include <sim/input/pair_scenario_file.hpp>
#include <sim/input/rigs.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/driven_results.hpp>
#include <sim/output/grid.hpp>
#include <sim/output/joint_tracking.hpp>
#include <sim/output/json_parts.hpp>

namespace mckibben::output {
namespace {

using input::Json;

Json slack_json(const run::Recording& recording) {
  Json list = Json::array();
  for (const run::Slack& slack : recording.slack)
    list.push_back({{"muscle", slack.muscle},
                    {"from_s", slack.from_s},
                    {"rows", slack.rows},
                    {"lowest_N", slack.lowest_N},
                    {"lowest_at_s", slack.lowest_at_s}});
  return list;
}

/// What is told of every ride that came to its end.
void put_ride(Json& entry, const plant::Rig& rig, const run::Recording& recording) {
  entry["slack"] = slack_json(recording);
  entry["largest_contraction_ratio"] = recording.largest_contraction_ratio;
  entry["ledger"] = ledger_json(rig, recording);
  if (recording.driven.length) entry["ledger"]["bench_work_J"] = recording.ledger.bench_work_J;
  entry["solver"] = solver_json(recording.solver);
}

std::string degrees(double angle_rad) {
  return rounded(angle_rad / plant::degree_rad, 2, true);
}

const std::string& name_of(const run::PairRun& run) {
  return run.name;
}
const std::string& name_of(const run::StampedRun& run) {
  return run.id;
}

template <class Runs>
std::string without_result(const Runs& runs, const std::vector<std::string>& warnings) {
  std::string failures, warned;
  for (const auto& run : runs)
    if (!run.failure.empty()) failures += fmt::format("  {}: {}\n", name_of(run), run.failure);
  for (const auto& text : warnings) warned += fmt::format("  {}\n", text);
  return section("no result", failures) + section("warnings", warned);
}

}  // namespace

std::string json_of(const domain::PairScenario& scenario, const run::PairRuns& all,
                    const std::vector<std::string>& warnings, bool interrupted) {
  Json document = heading_json("mckibben-pair-run/1", scenario.inputs);
  document["report"] = "report.html";
  document["tolerance"] = scenario.rig.integrator.tolerance;
  document["scenario"] = input::pair_scenario_json(scenario);
  document["tuned"] = Json::array();
  for (const auto& tuned : all.tuned) document["tuned"].push_back(tuned_json(scenario, tuned));
  document["runs"] = Json::array();
  for (const auto& run : all.runs) {
    Json entry{{"name", run.name}};
    if (run.followed) entry.update(followed_json(scenario, run));
    if (!run.recording.samples.empty()) entry["file"] = run.name + ".csv";
    if (!run.failure.empty()) {
      entry["failure"] = run.failure;
    } else {
      entry["angle_rad"] = span_json(run.angle_rad);
      entry["tension_1_N"] = span_json(run.cord_force_N);
      entry["tension_2_N"] = span_json(run.opposite_cord_force_N);
      put_ride(entry, scenario.rig, run.recording);
    }
    document["runs"].push_back(std::move(entry));
  }
  document["warnings"] = warnings;
  if (interrupted) document["interrupted"] = true;
  return text_of(document);
}

std::string json_of(const domain::Dataset& dataset, const std::vector<run::StampedRun>& runs,
                    const std::vector<std::string>& warnings, bool interrupted) {
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
  if (interrupted) document["interrupted"] = true;
  return text_of(document);
}

std::string gap_number(double value, bool sign) {
  return sign ? fmt::format("{:+.4g}", value) : fmt::format("{:.4g}", value);
}

std::string table_of(const domain::PairScenario& scenario, const run::PairRuns& all,
                     const std::vector<std::string>& warnings) {
  Grid grid({"run", "angle_deg lowest", "highest", "final", "tension_1_N lowest", "highest",
             "tension_2_N lowest", "highest", "air_g"},
            1);
  for (const auto& run : all.runs) {
    if (run.followed) continue;
    if (!run.failure.empty()) {
      grid.add({run.name, "no result", "-", "-", "-", "-", "-", "-", "-"});
      continue;
    }
    const auto newton = [](double value) { return fmt::format("{:.1f}", value); };
    grid.add({run.name, degrees(run.angle_rad.low), degrees(run.angle_rad.high),
              degrees(run::angle_rad(scenario.rig, run.recording.samples.back())),
              newton(run.cord_force_N.low), newton(run.cord_force_N.high),
              newton(run.opposite_cord_force_N.low), newton(run.opposite_cord_force_N.high),
              fmt::format("{:.3f}", 1e3 * run.recording.ledger.air_drawn_kg)});
  }
  const std::string tracking = tracking_text(scenario, all);
  std::string text =
      fmt::format("{}: two muscles, {} run{}, {:g} s each; joint angle positive as muscle 1 contracts\n",
                  scenario.name, all.runs.size(), all.runs.size() == 1 ? "" : "s", scenario.duration_s);
  if (!grid.empty()) text += (tracking.empty() ? "\n" : "\nunder given currents\n") + grid.text();
  if (!tracking.empty()) text += (grid.empty() ? "\n" : "\nunder controllers\n") + tracking;
  return text + without_result(all.runs, warnings);
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
