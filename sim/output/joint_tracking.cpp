// Layout; see the header.
#include <optional>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/output/grid.hpp>
#include <sim/output/joint_tracking.hpp>

namespace mckibben::output {
namespace {

using input::Json;

Json or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::string figure(const std::optional<double>& value, double factor, int digits) {
  return value ? fmt::format("{:.{}f}", factor * *value, digits) : "-";
}

/// Gain [mA/rad] of what was tuned.
double proportional(const domain::PairScenario& scenario, const run::TunedPair& tuned) {
  return tuned.tuned.gains.proportional_mA / run::rad_per_ratio(scenario.rig);
}

std::string tuned_line(const domain::PairScenario& scenario, const run::TunedPair& tuned) {
  return fmt::format(
      "  {} with {:g} kg: proportional {:.4g} mA/rad, integral_time {:.4g} s, derivative_time {:.4g} s "
      "({} trials)\n",
      tuned.controller, tuned.load_kg, proportional(scenario, tuned), tuned.tuned.gains.integral_time_s,
      tuned.tuned.gains.derivative_time_s, tuned.tuned.evaluations);
}

std::string findings_line(const run::PairRun& run) {
  std::string line;
  for (const auto& one : run.recording.findings)
    line += fmt::format("{}{} {:.4g}{}", line.empty() ? "" : ", ", one.name, one.value,
                        one.unit == "1" ? "" : " " + one.unit);
  return line.empty() ? "" : fmt::format("  {}: {}\n", run.name, line);
}

}  // namespace

Json followed_json(const domain::PairScenario& scenario, const run::PairRun& run) {
  const run::JointFollowed& followed = *run.followed;
  Json entry{{"target", scenario.targets[followed.target].name},
             {"load_kg", followed.load_kg},
             {"controller", name_of(scenario.controllers[followed.controller])}};
  if (!run.failure.empty()) return entry;
  const run::Metrics& m = followed.metrics;
  entry["rmse_rad"] = m.rmse;
  entry["largest_error_rad"] = m.largest_error;
  entry["final_error_rad"] = m.final_error;
  entry["time_lag_s"] = or_null(m.time_lag_s);
  entry["overshoot"] = or_null(m.overshoot);
  entry["settling_time_s"] = or_null(m.settling_time_s);
  entry["stiffness_N_m_per_rad"] = {{"asked", or_null(followed.stiffness_asked)},
                                    {"had", followed.stiffness_had},
                                    {"rmse", or_null(followed.stiffness_rmse)}};
  entry["at_limit"] = followed.at_limit;
  Json found = Json::object();
  for (const auto& one : run.recording.findings) found[one.name] = {{"value", one.value}, {"unit", one.unit}};
  if (!found.empty()) entry["found"] = std::move(found);
  return entry;
}

Json tuned_json(const domain::PairScenario& scenario, const run::TunedPair& tuned) {
  Json entry{{"controller", tuned.controller}, {"load_kg", tuned.load_kg}};
  if (!tuned.failure.empty()) {
    entry["failure"] = tuned.failure;
    return entry;
  }
  entry["proportional_mA_per_rad"] = proportional(scenario, tuned);
  entry["integral_time_s"] = tuned.tuned.gains.integral_time_s;
  entry["derivative_time_s"] = tuned.tuned.gains.derivative_time_s;
  entry["trials"] = tuned.tuned.evaluations;
  return entry;
}

std::string tracking_text(const domain::PairScenario& scenario, const run::PairRuns& all) {
  constexpr double deg = 1.0 / plant::degree_rad;
  Grid grid({"target", "load_kg", "controller", "rmse_deg", "largest", "final", "lag_ms", "overshoot_%",
             "stiffness_Nm/rad asked", "had", "rmse", "air_g", "at_limit_%"},
            3);
  std::string found, tuned;
  for (const run::PairRun& run : all.runs) {
    if (!run.followed) continue;
    const run::JointFollowed& followed = *run.followed;
    const run::Metrics& m = followed.metrics;
    std::vector<std::string> row{scenario.targets[followed.target].name,
                                 domain::write_number(followed.load_kg),
                                 name_of(scenario.controllers[followed.controller])};
    if (run.failure.empty())
      row.insert(row.end(), {figure(m.rmse, deg, 2), figure(m.largest_error, deg, 2),
                             fmt::format("{:+.2f}", deg * m.final_error), figure(m.time_lag_s, 1e3, 0),
                             figure(m.overshoot, 100.0, 1), figure(followed.stiffness_asked, 1.0, 2),
                             figure(followed.stiffness_had, 1.0, 2), figure(followed.stiffness_rmse, 1.0, 2),
                             figure(m.air_kg, 1e3, 3), fmt::format("{:.0f}", 100.0 * followed.at_limit)});
    else
      row.insert(row.end(), {"no result", "-", "-", "-", "-", "-", "-", "-", "-", "-"});
    grid.add(std::move(row));
    found += findings_line(run);
  }
  if (grid.empty()) return "";
  for (const auto& one : all.tuned)
    if (one.failure.empty()) tuned += tuned_line(scenario, one);
  return grid.text() + section("gains tuned, for all targets", tuned) +
         section("found out by the controllers", found);
}

}  // namespace mckibben::output
