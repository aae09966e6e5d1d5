// The report of `run`: which controller follows best, rmse by target, load and controller, and the runs that
// are compared with each other, drawn together; of two muscles also those under given currents.
#include <algorithm>
#include <span>
#include <variant>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/run_results.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/bands.hpp>
#include <sim/report/html.hpp>
#include <sim/report/length.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/report.hpp>
#include <sim/report/tables.hpp>
#include <sim/run/remarks.hpp>

namespace mckibben::report {
namespace {

using domain::Scenario;
using output::escaped;
using run::Comparison, run::tasks_of;

bool of_pair(const Scenario& scenario) {
  return scenario.rig.pair() != nullptr;
}
bool of_angle(const Scenario& scenario) {
  return scenario.rig.has_angle();
}

/// What a controller's mean is over: "4 loads", "3 of 4 loads".
std::string over_what(const Scenario& scenario, const run::ControllerSpread& row) {
  return fmt::format("{}{} {}", row.partial() ? fmt::format("{} of ", row.with_result) : "",
                     tasks_of(scenario).size(), of_pair(scenario) ? "runs" : "loads");
}

/// An error in a sentence: of the height of a load, or of the angle of a joint.
std::string full_error_html(double error, const Scenario& scenario) {
  return of_angle(scenario) ? fmt::format("{:.2f}°", in_degrees * error)
                            : full_length_html(error, scenario.rig, 2);
}
std::string error_html(double error, const Scenario& scenario) {
  return of_angle(scenario) ? fmt::format("{:.2f}", in_degrees * error) : length_html(error, scenario.rig);
}

std::string sentence_of_currents(const run::TrackedRun& run) {
  if (!run.failure.empty()) return fmt::format("{}: no result.", escaped(run.name));
  const run::JointFigures& joint = *run.joint;
  return fmt::format(
      "{}: the joint turns between {}° and {}°, the cords carry {:.0f} to {:.0f} N and {:.0f} to {:.0f} N.",
      escaped(run.name), output::rounded(in_degrees * joint.angle_rad.low, 1),
      output::rounded(in_degrees * joint.angle_rad.high, 1), joint.cord_force_N.low, joint.cord_force_N.high,
      joint.opposite_cord_force_N.low, joint.opposite_cord_force_N.high);
}

/// How far the loads move under a given current, in place of errors from a target that it does not follow.
std::string sentence_of_given(const Scenario& scenario, const Comparison& comparison,
                              const std::string& controller) {
  std::string text;
  for (const auto& run : comparison.runs) {
    if (run.controller != controller || !run.failure.empty() || run.recording.samples.empty()) continue;
    const auto ratio = [](const plant::Sample& sample) { return sample.state.joint.contraction_ratio; };
    const auto [low, high] = run::span_of(run.recording.samples, ratio);
    text += fmt::format("{} {} kg by {}", text.empty() ? ": it moves" : ",", domain::write_kg(run.load_kg),
                        full_length_html(high - low, scenario.rig, 1));
  }
  return fmt::format(" {} follows no target{}.", escaped(controller), text);
}

std::string sentence(const Scenario& scenario, const Comparison& comparison) {
  const run::ControllerSpread *best = nullptr, *worst = nullptr;
  std::string of_given;
  for (std::size_t c = 0; c < comparison.spreads.size(); ++c) {
    const auto& one = comparison.spreads[c];
    if (!one.rmse) continue;
    if (domain::is_given(scenario.controllers[c]) && !of_angle(scenario)) {
      of_given += sentence_of_given(scenario, comparison, one.controller);
      continue;
    }
    if (best == nullptr || one.rmse->mean < best->rmse->mean) best = &one;
    if (worst == nullptr || one.rmse->mean > worst->rmse->mean) worst = &one;
  }
  std::string text, given;
  for (const auto& run : comparison.runs)
    if (!run.followed()) given += ' ' + sentence_of_currents(run);
  if (best == nullptr && !of_given.empty()) return of_given.substr(1) + given;
  if (best == nullptr) return (scenario.controllers.empty() ? "" : "No run came to its end.") + given;
  const auto failed = std::count_if(comparison.runs.begin(), comparison.runs.end(),
                                    [](const auto& run) { return !run.failure.empty(); });
  const char* of_what = of_angle(scenario) ? "root mean square error of the angle" : "root mean square error";
  const std::string cycles = run::cycle_words(comparison, scenario.rig, best->controller);
  const std::string error =
      fmt::format("{} {}{}{}", of_what, full_error_html(best->rmse->mean, scenario),
                  tasks_of(scenario).size() == 1 ? "" : ", the mean over " + over_what(scenario, *best),
                  cycles.empty() ? "" : ", but it " + cycles);
  const std::string name = escaped(best->controller);
  if (best == worst)
    text = fmt::format("{}: {}.", name, error);
  else
    text = fmt::format("{} {}: {}. Of the {} controllers {} is the worst: {}{}.", name,
                       run::in_doubt(comparison, best->controller) ? "errs least" : "follows the target best",
                       error, comparison.spreads.size(), escaped(worst->controller),
                       full_error_html(worst->rmse->mean, scenario),
                       worst->partial() ? " over " + over_what(scenario, *worst) : "");
  if (const std::string stood = run::limit_words(comparison, scenario.rig, best->controller); !stood.empty())
    text += fmt::format(" {} {}.", name, stood);
  if (std::any_of(comparison.tuned.begin(), comparison.tuned.end(), [&](const auto& tuned) {
        return tuned.controller == best->controller && run::gained_nothing(tuned);
      }))
    text += fmt::format(" The tuning of {} gained nothing: see the warnings.", name);
  if (failed > 0) text += fmt::format(" {} of {} runs have no result.", failed, comparison.runs.size());
  if (!comparison.unmet.empty())
    text += fmt::format(" {} of the scenario's criteria {} not met.", comparison.unmet.size(),
                        comparison.unmet.size() == 1 ? "is" : "are");
  if (!comparison.unjudged.empty()) text += " Criteria cannot be evaluated where there is no result.";
  if (const std::string knowing = run::knowing_words(scenario); !knowing.empty())
    text += " " + escaped(knowing) + ".";
  return text + of_given + given;
}

std::string name_of(const Scenario& scenario, const run::Task& task) {
  const std::string load = domain::write_kg(task.load_kg) + " kg";
  if (!of_pair(scenario)) return load;
  const std::string& target = scenario.targets[task.target].name;
  return scenario.loads_kg.size() == 1 && task.load_kg == 0.0
             ? target
             : fmt::format("{}, {} in the hand", target, load);
}

/// The runs of one target with one load, in the order of the controllers.
std::span<const run::TrackedRun> runs_of(const Scenario& scenario, const Comparison& comparison,
                                         const run::Task& task) {
  return std::span(comparison.runs).subspan(task.first, scenario.controllers.size());
}

bool is_drawn(std::span<const run::TrackedRun> runs) {
  return std::ranges::any_of(runs, [](const auto& run) { return !run.recording.samples.empty(); });
}

std::string heads(const Scenario& scenario) {
  std::string html = fmt::format("<th scope='col'>{}</th>", of_pair(scenario) ? "target" : "load");
  for (const auto& one : scenario.controllers)
    html += "<th scope='col'>" + escaped(controllers::name_of(one)) + "</th>";
  return html;
}

/// Errors, a row for each target and load; the smallest of a row is marked.
std::string table(const Scenario& scenario, const Comparison& comparison) {
  const std::size_t columns = scenario.controllers.size();
  if (columns == 0 || run::follows_nothing(scenario, comparison)) return "";
  std::string html = fmt::format(
      "<table><caption>Root mean square error{}{}{}</caption>\n<thead><tr>{}</tr></thead>\n<tbody>\n",
      of_angle(scenario) ? " of the joint angle, deg" : ", " + length_unit_html(),
      run::counted_words(scenario, comparison), columns > 1 ? "; the smallest of each row is bold" : "",
      heads(scenario));
  bool marked = false;
  const auto row = [&](const std::string& head, const auto& rmse_of, const auto& mark_of) {
    std::optional<double> least;
    for (std::size_t c = 0; c < columns; ++c)
      if (const std::optional<double> rmse = rmse_of(c); rmse && (!least || *rmse < *least)) least = rmse;
    html += head;
    for (std::size_t c = 0; c < columns; ++c) {
      const std::optional<double> rmse = rmse_of(c);
      const std::string mark = mark_of(c);
      marked = marked || mark.find_first_of("*+") != std::string::npos;
      html += rmse ? fmt::format("<td{}>{}{}</td>", rmse == least && columns > 1 ? " class='best'" : "",
                                 error_html(*rmse, scenario), mark)
                   : "<td>no result</td>";
    }
    html += "</tr>\n";
  };
  std::size_t group = 0;  // tasks without any row have none
  const std::vector<run::Task> tasks = tasks_of(scenario);
  for (const run::Task& task : tasks) {
    const auto runs = runs_of(scenario, comparison, task);
    const bool shown = is_drawn(runs);
    const std::string name = name_of(scenario, task);
    row(
        shown ? fmt::format("<tr data-group='{}'><th scope='row'>{}</th>", group, link_html(group, name))
              : fmt::format("<tr><th scope='row'>{}</th>", escaped(name)),
        [&](std::size_t c) {
          return runs[c].failure.empty() ? std::optional(runs[c].metrics.rmse) : std::nullopt;
        },
        [&](std::size_t c) { return runs[c].failure.empty() ? output::extrapolation_mark(runs[c]) : ""; });
    if (shown) ++group;
  }
  if (tasks.size() > 1)
    row(
        "<tr class='mean'><th scope='row'>mean</th>",
        [&](std::size_t c) {
          const auto& rmse = comparison.spreads[c].rmse;
          return rmse ? std::optional(rmse->mean) : std::nullopt;
        },
        [&](std::size_t c) { return output::mean_mark(comparison, comparison.spreads[c].controller); });
  html += "</tbody></table>\n";
  if (marked)
    html +=
        "<p class='small'>* extrapolated: load or target outside the calibrated range; + load taken as the "
        "end of that range</p>\n";
  return html;
}

/// How long each run was at a limit of its current; empty where none was for 1 % of its time.
std::string limits_table(const Scenario& scenario, const Comparison& comparison) {
  std::string rows;
  double most = 0.0;
  for (const run::Task& task : tasks_of(scenario)) {
    rows += "<tr><th scope='row'>" + escaped(name_of(scenario, task)) + "</th>";
    for (const run::TrackedRun& run : runs_of(scenario, comparison, task)) {
      const bool told = (run.limits || run.joint) && run.failure.empty();
      const double share = told ? run::share_at_limit(run) : 0.0;
      most = std::max(most, share);
      rows += told ? fmt::format("<td>{:.0f}</td>", 100.0 * share) : "<td>-</td>";
    }
    rows += "</tr>\n";
  }
  if (most < 0.01) return "";
  return fmt::format(
      "<details class='limits'><summary>Controllers stood at a limit of their {0} for up to {1:.0f} % of "
      "the time</summary>\n<table><caption>Share of the time at the lowest or highest {0}, in "
      "%</caption>\n<thead><tr>{2}</tr></thead>\n<tbody>\n{3}</tbody></table>\n"
      "</details>\n",
      plant::command_key(scenario.rig), 100.0 * most, heads(scenario), rows);
}

Run shown(const Scenario& scenario, const run::TrackedRun& run, const std::string& name, std::size_t style) {
  return {.name = name,
          .style = style,
          .ticks = run.recording.samples.size(),
          .quantities = quantities_of(run.recording, scenario.rig)};
}

Group group_of(const Scenario& scenario, const Comparison& comparison, const run::Task& task) {
  const run::Wanted& wanted = comparison.targets[task.target];
  const auto* target = &wanted.values;
  const bool pair = of_pair(scenario), angle = of_angle(scenario);
  Group group{.name = name_of(scenario, task), .load_kg = task.load_kg, .ticks = target->size()};
  if (angle) {
    group.given.push_back({"given_angle", [target](std::size_t k) { return in_degrees * (*target)[k]; }});
    if (const auto* stiffness = &wanted.stiffness_N_m_per_rad; !stiffness->empty())
      group.given.push_back({"given_stiffness", [stiffness](std::size_t k) { return (*stiffness)[k]; }});
  } else {
    group.given.push_back({"given_contraction_ratio", [target](std::size_t k) { return (*target)[k]; }});
  }
  if (!pair) {
    const double weight_N = plant::Plant(scenario.rig, task.load_kg).weight_N();
    group.given.push_back({"weight", [weight_N](std::size_t) { return weight_N; }});
  }
  const auto runs = runs_of(scenario, comparison, task);
  for (std::size_t c = 0; c < runs.size(); ++c) {
    const auto* rows = &runs[c].recording.samples;
    if (rows->empty()) continue;
    Run run = shown(scenario, runs[c], runs[c].controller, c);
    run.quantities.push_back({"error", [rows, target, angle](std::size_t k) {
                                return angle ? in_degrees * ((*rows)[k].angle_rad - (*target)[k])
                                             : (*rows)[k].state.joint.contraction_ratio - (*target)[k];
                              }});
    group.runs.push_back(std::move(run));
  }
  return group;
}

PlotsOf followed(const Scenario& scenario, const Comparison& comparison) {
  if (run::follows_nothing(scenario, comparison))
    return of_angle(scenario) ? PlotsOf{.key = "angle", .title = "Joint angle"}
                              : PlotsOf{.title = "Contraction"};
  if (scenario.rig.lever() != nullptr)
    return {
        .key = "angle", .title = "Joint angle", .given = "target", .error = "Joint angle: angle less target"};
  if (!of_pair(scenario))
    return {.title = "Target and contraction", .given = "Target", .error = "Error: contraction less target"};
  const bool targets = !scenario.targets.empty();
  return {.driven = {.pair = true},
          .key = "angle",
          .title = "Joint angle",
          .given = targets ? "target" : "",
          .error = targets ? "Joint angle: angle less target" : ""};
}

PlotsOf plots_for(const Scenario& scenario, const Comparison& comparison) {
  PlotsOf of = followed(scenario, comparison);
  of.driven.joint_force = !scenario.outer_forces.empty() || !scenario.outer_torques.empty();
  return of;
}

}  // namespace

std::string report_html(const Scenario& scenario, const Comparison& comparison) {
  const bool pair = of_pair(scenario);
  const std::size_t loads = scenario.loads_kg.size();
  const std::string of_what = pair         ? "two muscles on one wheel"
                              : loads == 1 ? "one load"
                                           : fmt::format("{} loads", loads);
  Contents contents{.title = scenario.name,
                    .about = fmt::format("Simulated: {}, {:g} s each", of_what, scenario.duration_s),
                    .warnings = comparison.warnings,
                    .sentence = sentence(scenario, comparison),
                    .table = table(scenario, comparison) + limits_table(scenario, comparison),
                    .details = output::table_of(scenario, comparison),
                    .beside = std::string(beside_runs),
                    .chapters = {robustness(scenario, comparison)},
                    .lengths = !of_angle(scenario),
                    .rig = scenario.rig,
                    .gauge = !pair && scenario.rig.sensors.of(plant::Sensed::muscle_pressure) != nullptr,
                    .plots = plots_of(scenario.rig, plots_for(scenario, comparison)),
                    .loops = loops_of(scenario.rig, {.pair = pair})};
  for (const run::Task& task : tasks_of(scenario))
    if (is_drawn(runs_of(scenario, comparison, task)))
      contents.groups.push_back(group_of(scenario, comparison, task));
  for (const run::TrackedRun& run : comparison.runs) {
    if (run.followed() || run.recording.samples.empty()) continue;
    Group group{.name = run.name, .ticks = run.recording.samples.size()};
    group.runs.push_back(shown(scenario, run, "simulated", 0));
    contents.groups.push_back(std::move(group));
  }
  return html_of(contents);
}

}  // namespace mckibben::report
