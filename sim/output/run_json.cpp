// Layout of the JSON documents.
#include <optional>

#include <plant/geometry.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/output/json_parts.hpp>
#include <sim/output/run_results.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/remarks.hpp>

namespace mckibben::output {
namespace {

using input::Json;

Json or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json beyond_json(const run::Beyond& beyond, const char* asked, const char* limit) {
  return {{"ticks", beyond.ticks},
          {asked, beyond.asked},
          {limit, beyond.limit},
          {"at_contraction_ratio", beyond.ratio},
          {"direction", beyond.up ? "up" : "down"}};
}

/// Only the limits that the target passes.
Json unreachable_json(const run::Unreachable& found) {
  Json entry{{"ticks", found.ticks},
             {"of_ticks", found.of_ticks},
             {"ticks_without_current_speed", found.ticks_without_current_speed}};
  if (found.too_fast.ticks > 0)
    entry["too_fast"] = beyond_json(found.too_fast, "asked_per_s", "largest_reachable_per_s");
  if (found.too_high.ticks > 0)
    entry["too_high"] = beyond_json(found.too_high, "asked_ratio", "largest_reachable_ratio");
  if (found.too_low.ticks > 0)
    entry["too_low"] = beyond_json(found.too_low, "asked_ratio", "smallest_reachable_ratio");
  return entry;
}

/// What is told of two muscles and their joint besides.
void put_joint(Json& entry, const run::TrackedRun& run) {
  const run::JointFigures& joint = *run.joint;
  entry["angle_rad"] = span_json(joint.angle_rad);
  entry["tension_1_N"] = span_json(joint.cord_force_N);
  entry["tension_2_N"] = span_json(joint.opposite_cord_force_N);
  entry["slack"] = run.recording.slack;
  if (!run.followed()) return;
  entry["stiffness_N_m_per_rad"] = {{"asked", or_null(joint.stiffness_asked)},
                                    {"had", joint.stiffness_had},
                                    {"rmse", or_null(joint.stiffness_rmse)}};
  entry["at_limit"] = joint.at_limit;
}

/// Errors of a joint are in rad, and their keys say so.
void put_metrics(Json& entry, const run::Metrics& m, const plant::Rig& rig, plant::CommandUnit commands) {
  const std::string unit = rig.has_angle() ? "_rad" : "";
  entry["rmse" + unit] = m.rmse;
  entry["mae" + unit] = m.mae;
  entry["largest_error" + unit] = m.largest_error;
  entry["final_error" + unit] = m.final_error;
  entry["time_lag_s"] = or_null(m.time_lag_s);
  entry["overshoot"] = or_null(m.overshoot);
  entry["settling_time_s"] = or_null(m.settling_time_s);
  entry[in_unit(commands, "current_travel_mA")] = m.current_travel_mA;
  if (rig.pair() != nullptr) return;
  entry[in_unit(commands, "at_lowest_current")] = or_null(m.at_lowest_current);
  entry[in_unit(commands, "at_highest_current")] = or_null(m.at_highest_current);
}

Json run_json(const domain::Scenario& scenario, const run::Comparison& comparison,
              const run::TrackedRun& run) {
  Json entry;
  const bool pair = scenario.rig.pair() != nullptr;
  if (pair) entry["name"] = run.name;
  if (run.followed()) {
    if (pair) entry["target"] = comparison.targets[run.target].name;
    entry["load_kg"] = run.load_kg;
    entry["controller"] = run.controller;
  }
  if (!run.recording.samples.empty()) entry["file"] = run.name + ".csv";
  if (run.unreachable.any()) entry["unreachable"] = unreachable_json(run.unreachable);
  if (!run.failure.empty()) {
    entry["failure"] = run.failure;
    return entry;
  }
  if (run.followed())
    entry["skip_s"] =
        run::tidy_s(static_cast<double>(comparison.targets[run.target].first) * scenario.rig.tick_s);
  if (run.followed()) put_metrics(entry, run.metrics, scenario.rig, scenario.rig.command_unit());
  if (run.joint) put_joint(entry, run);
  entry["contraction"] = contraction_json(scenario.rig, run.recording);
  entry["ledger"] = ledger_json(scenario.rig, run.recording);
  entry["solver"] = solver_json(run.recording.solver);
  for (const auto& one : run.recording.findings)
    entry["findings"][one.name] = {{"value", one.value}, {"unit", one.unit}};
  return entry;
}

Json robustness_json(const run::Comparison& comparison) {
  Json rows = Json::array();
  for (const auto& row : comparison.robustness)
    rows.push_back({{"load_kg", row.load_kg},
                    {"controller", row.controller},
                    {"rigs", row.rigs},
                    {"rmse", row.rmse ? Json{{"at_5_percent", row.rmse->low},
                                             {"median", row.rmse->median},
                                             {"at_95_percent", row.rmse->high}}
                                      : Json()},
                    {"failures", row.failures},
                    {"limit_cycles", row.limit_cycles},
                    {"saturated", row.saturated},
                    {"over_contracted", row.over_contracted},
                    {"no_result", row.no_result},
                    {"why_no_result", row.why}});
  return {{"drawn", comparison.drawn}, {"rows", std::move(rows)}};
}

}  // namespace

std::string json_of(const domain::Scenario& scenario, const run::Comparison& comparison) {
  Json document = heading_json("mckibben-run/1", scenario.inputs);
  document["report"] = "report.html";
  document["seed"] = scenario.seed;
  document["tolerance"] = scenario.rig.integrator.tolerance;
  document["scenario"] = input::scenario_json(scenario);
  document["tuned"] = Json::array();
  const bool angle = scenario.rig.has_angle();
  for (const auto& row : comparison.tuned) {
    if (!row.failure.empty()) continue;
    document["tuned"].push_back(
        {{"controller", row.controller},
         {"load_kg", row.load_kg},
         {in_unit(scenario.rig.command_unit(), angle ? "proportional_mA_per_rad" : "proportional_mA"),
          row.tuned.gains.proportional_mA / run::per_ratio(scenario.rig)},
         {"integral_time_s", row.tuned.gains.integral_time_s},
         {"derivative_time_s", row.tuned.gains.derivative_time_s},
         {"cost", row.tuned.cost},
         {"cost_at_start", or_null(row.tuned.start_cost)},
         {"cost_without_feedback", or_null(row.idle_cost)},
         {"gained_nothing", run::gained_nothing(row)},
         {"evaluations", row.tuned.evaluations}});
  }
  if (!comparison.robustness.empty()) document["robustness"] = robustness_json(comparison);
  document["runs"] = Json::array();
  for (const auto& run : comparison.runs) document["runs"].push_back(run_json(scenario, comparison, run));
  document["spreads"] = Json::array();
  for (const auto& row : comparison.spreads) {
    Json entry{{"controller", row.controller}, {"runs", row.runs}, {"runs_with_result", row.with_result}};
    if (row.rmse)
      entry[scenario.rig.has_angle() ? "rmse_rad" : "rmse"] = {
          {"mean", row.rmse->mean},
          {"lowest", row.rmse->lowest},
          {"highest", row.rmse->highest},
          {"spread", row.rmse->width()},
          {"standard_deviation", row.rmse->standard_deviation}};
    document["spreads"].push_back(std::move(entry));
  }
  document["criteria_not_met"] = comparison.unmet;
  document["criteria_not_evaluated"] = comparison.unjudged;
  document["warnings"] = comparison.warnings;
  if (comparison.interrupted) document["interrupted"] = true;
  return text_of(document);
}

}  // namespace mckibben::output
