// Layout of the tables of runs.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/domain/number.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/grid.hpp>
#include <sim/output/run_results.hpp>
#include <sim/run/remarks.hpp>

namespace mckibben::output {
/// Thesis 2.3: what contraction does to a muscle.
std::string contraction_note(const plant::Rig& rig, double reached, const std::string& who) {
  switch (plant::danger_of(rig.muscle, reached)) {
    case plant::Danger::impossible:
      return fmt::format(
          "  {}: contraction ratio {:.4f} is above e_max = {:.4f}: impossible for a real muscle (T 2.3)\n",
          who, reached, plant::Braid(rig.muscle).largest_contraction_ratio());
    case plant::Danger::risk:
      return fmt::format("  {}: contraction ratio {:.4f} is above {:.2f}: a risk to the muscle (T 2.3)\n",
                         who, reached, plant::risky_contraction_ratio);
    case plant::Danger::safe:
      break;
  }
  return "";
}

namespace {

std::string cell(std::optional<double> value, double factor, int decimals) {
  return value ? fmt::format("{:.{}f}", *value * factor, decimals) : "-";
}

std::string ratio(double value) {
  return fmt::format("{:.5f}", value);
}

std::string footnotes(const std::vector<run::TrackedRun>& runs) {
  const auto any = [&](const char* sign) {
    return std::any_of(runs.begin(), runs.end(),
                       [&](const auto& run) { return extrapolation_mark(run) == sign; });
  };
  std::string text;
  if (any("*"))
    text +=
        "  * extrapolated: the load, or where the target leads, is outside the calibrated range; a mean with "
        "* holds such a run\n";
  if (any("+"))
    text +=
        "  + the load was weighed less than 10 % outside the calibrated range and taken as the range's end; "
        "not extrapolated\n";
  return text;
}

std::string percent(std::optional<double> share) {
  return share ? fmt::format("{:.0f}", 100.0 * *share) : "-";
}

std::string degrees(double angle_rad) {
  return rounded(angle_rad / plant::degree_rad, 2, true);
}

std::string error_in_degrees(double error_rad) {
  return fmt::format("{:.2f}", error_rad / plant::degree_rad);
}

std::string tuned_line(const plant::Rig& rig, const run::TunedController& row,
                       const run::Comparison& comparison) {
  const std::string cycles = run::cycle_words(comparison, rig, row.controller);
  const auto cost = [](std::optional<double> value) {
    return value ? fmt::format("{:.3g}", *value) : std::string("no result");
  };
  return fmt::format(
      "  {} at {:g} kg: proportional {:.4g} {}, integral_time {:.4g} s, derivative_time {:.4g} s ({} runs); "
      "cost {:.3g}, at the start {}, without feedback {}{}{}\n",
      row.controller, row.load_kg, row.tuned.gains.proportional_mA / run::per_ratio(rig),
      in_unit(rig.command_unit(), rig.has_angle() ? "mA/rad" : "mA"), row.tuned.gains.integral_time_s,
      row.tuned.gains.derivative_time_s, row.tuned.evaluations, row.tuned.cost, cost(row.tuned.start_cost),
      cost(row.idle_cost), run::gained_nothing(row) ? ": the tuning gained nothing" : "",
      cycles.empty() ? "" : "; it " + cycles);
}

std::string robustness(const run::Comparison& comparison) {
  Grid grid({"load_kg", "controller", "rmse 5 %", "median", "95 %", "failures", "limit cycle", "saturated",
             "above 0.20", "no result"},
            2);
  std::string why;
  for (const auto& row : comparison.robustness) {
    const auto count = [](std::size_t number) { return number == 0 ? "-" : std::to_string(number); };
    grid.add({domain::write_kg(row.load_kg), row.controller, row.rmse ? ratio(row.rmse->low) : "-",
              row.rmse ? ratio(row.rmse->median) : "-", row.rmse ? ratio(row.rmse->high) : "-",
              count(row.failures), count(row.limit_cycles), count(row.saturated), count(row.over_contracted),
              count(row.no_result)});
    if (!row.why.empty())
      why +=
          fmt::format("  no result: {} kg, {}: {}\n", domain::write_kg(row.load_kg), row.controller, row.why);
  }
  return grid.empty() ? "" : grid.text() + why;
}

std::string contraction_notes(const domain::Scenario& scenario, const run::Comparison& comparison) {
  std::string text;
  if (scenario.rig.pair() != nullptr) return text;  // whose muscles may differ
  for (const auto& run : comparison.runs)
    text += contraction_note(scenario.rig, run.recording.largest_contraction_ratio, run.id);
  return text;
}

std::string findings(const run::Comparison& comparison) {
  std::string text;
  for (const auto& run : comparison.runs) {
    std::string line;
    for (const auto& one : run.recording.findings) {
      if (one.unit == "1" && one.value == 0.0) continue;  // nothing to say: no tick was outside
      line += fmt::format("{}{} {:.4g}{}", line.empty() ? "" : ", ", one.name, one.value,
                          one.unit == "1" ? "" : " " + one.unit);
    }
    if (!line.empty()) text += fmt::format("  {}: {}\n", run.id, line);
  }
  return text;
}

}  // namespace

std::string extrapolation_mark(const run::TrackedRun& run) {
  const auto has = [&](const char* name) {
    return controllers::value_of(run.recording.findings, name) != 0.0;
  };
  return has("load_extrapolated") || has("ticks_extrapolated") ? "*"
         : has("load_taken_as_range_end")                      ? "+"
                                                               : "";
}

std::string mean_mark(const run::Comparison& comparison, const std::string& controller) {
  const auto is_extrapolated = [&](const run::TrackedRun& run) {
    return run.controller == controller && run.failure.empty() && extrapolation_mark(run) == "*";
  };
  std::string mark = std::ranges::any_of(comparison.runs, is_extrapolated) ? "*" : "";
  const auto row = std::ranges::find(comparison.spreads, controller, &run::ControllerSpread::controller);
  if (row != comparison.spreads.end() && row->partial())
    mark += fmt::format(" ({} of {} {})", row->with_result, row->runs,
                        comparison.targets.size() > 1 ? "runs" : "loads");
  return mark;
}

namespace {

/// Errors as contraction ratios and lengths, a line for each load under each controller.
std::string lines_of_one(const domain::Scenario& scenario, const run::Comparison& comparison) {
  const double length_mm = 1e3 * scenario.rig.muscle.rest_length_m;
  const bool angle = scenario.rig.has_angle();
  std::vector<std::string> heads{"load_kg",    "controller", angle ? "rmse_deg" : "rmse",
                                 "rmse_mm",    "mae",        "largest",
                                 "final",      "lag_ms",     "overshoot_%",
                                 "settling_s", "air_g",      "at_limit_%"};
  if (angle) std::erase(heads, "rmse_mm");
  Grid grid(heads, 2);
  for (const auto& run : comparison.runs) {
    const auto& m = run.metrics;
    const std::vector<std::string> head{domain::write_kg(run.load_kg),
                                        run.controller + extrapolation_mark(run)};
    if (!run.failure.empty()) {
      grid.add(head, "no result");
      continue;
    }
    std::vector<std::string> cells =
        angle ? std::vector{error_in_degrees(m.rmse), error_in_degrees(m.mae),
                            error_in_degrees(m.largest_error),
                            fmt::format("{:+.2f}", m.final_error / plant::degree_rad)}
              : std::vector{ratio(m.rmse), cell(m.rmse, length_mm, 2), ratio(m.mae), ratio(m.largest_error),
                            fmt::format("{:+.5f}", m.final_error)};
    for (std::string& more :
         std::vector{cell(m.time_lag_s, 1e3, 0), cell(m.overshoot, 100.0, 1), cell(m.settling_time_s, 1.0, 2),
                     cell(m.air_kg, 1e3, 3),
                     percent(run.limits ? std::optional(run::share_at_limit(run)) : std::nullopt)})
      cells.push_back(std::move(more));
    grid.add(head, cells);
  }
  return grid.text() + footnotes(comparison.runs);
}

/// How far the loads move under given commands, where nothing is to follow a target.
std::string lines_of_moves(const domain::Scenario& scenario, const run::Comparison& comparison) {
  const bool angle = scenario.rig.has_angle();
  const std::string unit = angle ? "_deg" : "_mm";
  Grid grid({"load_kg", "controller", "lowest" + unit, "highest" + unit, "travel" + unit, "final" + unit,
             "air_g", "at_limit_%"},
            2);
  for (const auto& run : comparison.runs) {
    const std::vector<std::string> head{domain::write_kg(run.load_kg), run.controller};
    if (!run.failure.empty() || run.recording.samples.empty()) {
      grid.add(head, "no result");
      continue;
    }
    const auto place = [&](const plant::Sample& sample) {
      return angle ? sample.angle_rad / plant::degree_rad
                   : 1e3 * scenario.rig.muscle.rest_length_m * sample.state.joint.contraction_ratio;
    };
    const auto [low, high] = run::span_of(run.recording.samples, place);
    const auto shown = [](double value) { return fmt::format("{:.2f}", value); };
    grid.add(head, {shown(low), shown(high), shown(high - low), shown(place(run.recording.samples.back())),
                    cell(run.metrics.air_kg, 1e3, 3),
                    percent(run.limits ? std::optional(run::share_at_limit(run)) : std::nullopt)});
  }
  return grid.text();
}

/// What the rmse is over all runs of each controller.
std::string spreads(const domain::Scenario& scenario, const run::Comparison& comparison) {
  const bool angle = scenario.rig.has_angle();
  std::vector<std::string> heads{"controller", "rmse mean", "mean_mm", "lowest",
                                 "highest",    "spread",    "std dev"};
  if (angle) heads = {"controller", "rmse_deg mean", "lowest", "highest", "spread", "std dev"};
  Grid grid(heads, 1);
  for (const auto& row : comparison.spreads)
    if (row.rmse && angle)
      grid.add({row.controller + mean_mark(comparison, row.controller), error_in_degrees(row.rmse->mean),
                error_in_degrees(row.rmse->lowest), error_in_degrees(row.rmse->highest),
                error_in_degrees(row.rmse->width()), error_in_degrees(row.rmse->standard_deviation)});
    else if (row.rmse)
      grid.add({row.controller + mean_mark(comparison, row.controller), ratio(row.rmse->mean),
                cell(row.rmse->mean, 1e3 * scenario.rig.muscle.rest_length_m, 2), ratio(row.rmse->lowest),
                ratio(row.rmse->highest), ratio(row.rmse->width()), ratio(row.rmse->standard_deviation)});
  return grid.empty() ? "" : grid.text();
}

/// Of two muscles under given currents.
std::string lines_of_currents(const run::Comparison& comparison) {
  Grid grid({"run", "angle_deg lowest", "highest", "final", "tension_1_N lowest", "highest",
             "tension_2_N lowest", "highest", "air_g"},
            1);
  const auto newton = [](double value) { return fmt::format("{:.1f}", value); };
  for (const auto& run : comparison.runs) {
    if (run.followed()) continue;
    if (!run.failure.empty())
      grid.add({run.name}, "no result");
    else
      grid.add(
          {run.name},
          {degrees(run.joint->angle_rad.low), degrees(run.joint->angle_rad.high),
           degrees(run.recording.samples.back().angle_rad), newton(run.joint->cord_force_N.low),
           newton(run.joint->cord_force_N.high), newton(run.joint->opposite_cord_force_N.low),
           newton(run.joint->opposite_cord_force_N.high), cell(run.recording.ledger.air_drawn_kg, 1e3, 3)});
  }
  return grid.empty() ? "" : grid.text();
}

/// Errors as joint angles, a line for each target and load under each controller.
std::string lines_of_joint(const run::Comparison& comparison) {
  constexpr double deg = 1.0 / plant::degree_rad;
  Grid grid({"target", "load_kg", "controller", "rmse_deg", "largest", "final", "lag_ms", "overshoot_%",
             "stiffness_Nm/rad asked", "had", "rmse", "air_g", "at_limit_%"},
            3);
  for (const auto& run : comparison.runs) {
    if (!run.followed()) continue;
    const auto& m = run.metrics;
    const std::vector<std::string> head{comparison.targets[run.target].name, domain::write_kg(run.load_kg),
                                        run.controller};
    if (!run.failure.empty())
      grid.add(head, "no result");
    else
      grid.add(head, {cell(m.rmse, deg, 2), cell(m.largest_error, deg, 2),
                      fmt::format("{:+.2f}", deg * m.final_error), cell(m.time_lag_s, 1e3, 0),
                      cell(m.overshoot, 100.0, 1), cell(run.joint->stiffness_asked, 1.0, 2),
                      cell(run.joint->stiffness_had, 1.0, 2), cell(run.joint->stiffness_rmse, 1.0, 2),
                      cell(m.air_kg, 1e3, 3), percent(run.joint->at_limit)});
  }
  return grid.empty() ? "" : grid.text();
}

std::string plural(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string heading(const domain::Scenario& scenario, const run::Comparison& comparison) {
  std::string counted = run::counted_words(scenario, comparison);
  if (scenario.rig.pair() != nullptr) {
    if (!counted.empty()) counted.erase(0, 1);
    return fmt::format("{}: two muscles, {}, {:g} s each; joint angle positive as muscle 1 contracts{}{}\n",
                       scenario.name, plural(comparison.runs.size(), "run"), scenario.duration_s,
                       counted.empty() ? "" : "; errors count", counted);
  }
  if (run::follows_nothing(scenario, comparison))
    return fmt::format("{}: {}, {:g} s each; commands are given, and there is no target\n", scenario.name,
                       plural(comparison.runs.size(), "run"), scenario.duration_s);
  return fmt::format(
      "{}: {} x {}, {:g} s each; errors are {}{}\n", scenario.name, plural(scenario.loads_kg.size(), "load"),
      plural(scenario.controllers.size(), "controller"), scenario.duration_s,
      scenario.rig.has_angle()
          ? "joint angles"
          : fmt::format("contraction ratios (0.001 = {:g} mm)", scenario.rig.muscle.rest_length_m),
      counted);
}

std::string lines(const std::vector<std::string>& texts) {
  std::string all;
  for (const auto& text : texts) all += "  " + text + "\n";
  return all;
}

}  // namespace

std::string table_of(const domain::Scenario& scenario, const run::Comparison& comparison) {
  std::string text = heading(scenario, comparison), tuned, failures;
  for (const auto& row : comparison.tuned)
    if (row.failure.empty()) tuned += tuned_line(scenario.rig, row, comparison);
  for (const auto& run : comparison.runs)
    if (!run.failure.empty()) failures += fmt::format("  {}: {}\n", run.id, run.failure);

  const bool pair = scenario.rig.pair() != nullptr;
  if (pair) {
    const std::string given = lines_of_currents(comparison), followed = lines_of_joint(comparison);
    const bool both = !given.empty() && !followed.empty();
    if (!given.empty()) text += (both ? "\nunder given currents\n" : "\n") + given;
    if (!followed.empty()) text += (both ? "\nunder controllers\n" : "\n") + followed;
  } else if (run::follows_nothing(scenario, comparison)) {
    text += "\n" + lines_of_moves(scenario, comparison);
  } else {
    text += "\n" + lines_of_one(scenario, comparison) +
            section("rmse over the loads (spread: highest less lowest)", spreads(scenario, comparison));
  }
  if (!comparison.robustness.empty())
    text += section(fmt::format("on {} rigs drawn within their ± ({})", scenario.robustness.rigs,
                                plural(comparison.drawn.size(), "number")),
                    robustness(comparison));
  const std::string knowing = run::knowing_words(scenario);
  if (!knowing.empty()) text += "\n" + knowing + "\n";
  return text + section(pair ? "gains tuned, for all targets" : "gains tuned", tuned) +
         section("found out by the controllers", findings(comparison)) +
         section("contraction", contraction_notes(scenario, comparison)) + section("no result", failures) +
         section("criteria not met", lines(comparison.unmet)) +
         section("criteria that cannot be evaluated", lines(comparison.unjudged)) +
         section("warnings", pair ? lines(comparison.warnings) : "");
}

}  // namespace mckibben::output
