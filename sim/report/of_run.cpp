// The report of `run`: which controller follows best, rmse by load and controller, the runs of each load.
#include <algorithm>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/output/svg.hpp>
#include <sim/output/table.hpp>
#include <sim/report/bands.hpp>
#include <sim/report/by_load.hpp>
#include <sim/report/html.hpp>
#include <sim/report/length.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/report.hpp>
#include <sim/run/remarks.hpp>

namespace mckibben::report {
namespace {

using output::escaped;

std::string loads_text(std::size_t count) {
  return count == 1 ? "one load" : fmt::format("{} loads", count);
}

std::string sentence(const domain::Scenario& scenario, const run::Comparison& comparison) {
  const run::ControllerSpread *best = nullptr, *worst = nullptr;
  for (const auto& one : comparison.spreads) {
    if (!one.rmse) continue;
    if (best == nullptr || one.rmse->mean < best->rmse->mean) best = &one;
    if (worst == nullptr || one.rmse->mean > worst->rmse->mean) worst = &one;
  }
  if (best == nullptr) return "No run came to its end.";
  const auto loads = scenario.loads_kg.size();
  const auto failed = std::count_if(comparison.runs.begin(), comparison.runs.end(),
                                    [](const auto& run) { return !run.failure.empty(); });
  const std::string error = fmt::format(
      "root mean square error {}{}", full_length_html(best->rmse->mean, scenario.rig, 2),
      loads == 1 ? "" : ", the mean over " + (failed > 0 ? "the loads with a result" : loads_text(loads)));
  const std::string name = escaped(best->controller);
  std::string text = fmt::format("{}: {}.", name, error);
  if (best != worst)
    text = fmt::format("{} {}: {}. Of the {} controllers {} is the worst: {}.", name,
                       run::in_doubt(comparison, best->controller) ? "errs least" : "follows the target best",
                       error, comparison.spreads.size(), escaped(worst->controller),
                       full_length_html(worst->rmse->mean, scenario.rig, 2));
  if (const std::string stood = run::limit_words(comparison, best->controller); !stood.empty())
    text += fmt::format(" {} {}.", name, stood);
  if (std::any_of(comparison.tuned.begin(), comparison.tuned.end(), [&](const auto& tuned) {
        return tuned.controller == best->controller && run::gained_nothing(tuned);
      }))
    text += fmt::format(" The tuning of {} gained nothing: see the warnings.", name);
  if (failed > 0) text += fmt::format(" {} of {} runs have no result.", failed, comparison.runs.size());
  if (!comparison.unmet.empty())
    text += fmt::format(" {} of the scenario's criteria {} not met.", comparison.unmet.size(),
                        comparison.unmet.size() == 1 ? "is" : "are");
  return text;
}

/// rmse in mm, a row for each load; the smallest of a row is marked.
std::string table(const domain::Scenario& scenario, const run::Comparison& comparison) {
  const std::size_t columns = scenario.controllers.size();
  std::string html = "<table><caption>Root mean square error, " + length_unit_html() +
                     (columns > 1 ? "; the smallest of each row is bold" : "") +
                     "</caption>\n<thead><tr><th scope='col'>load</th>";
  for (const auto& one : scenario.controllers)
    html += "<th scope='col'>" + escaped(controllers::name_of(one)) + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  bool marked = false;
  const auto row = [&](const std::string& head, const auto& rmse_of, const auto& mark_of) {
    std::optional<double> least;
    for (std::size_t c = 0; c < columns; ++c)
      if (const std::optional<double> rmse = rmse_of(c); rmse && (!least || *rmse < *least)) least = rmse;
    html += head;
    for (std::size_t c = 0; c < columns; ++c) {
      const std::optional<double> rmse = rmse_of(c);
      const std::string mark = mark_of(c);
      marked = marked || !mark.empty();
      html += rmse ? fmt::format("<td{}>{}{}</td>", rmse == least && columns > 1 ? " class='best'" : "",
                                 length_html(*rmse, scenario.rig), mark)
                   : "<td>no result</td>";
    }
    html += "</tr>\n";
  };
  std::size_t group = 0;  // loads without any row have none
  for (std::size_t r = 0; r < scenario.loads_kg.size(); ++r) {
    const auto run = [&](std::size_t c) -> const run::TrackedRun& {
      return comparison.runs[r * columns + c];
    };
    bool shown = false;
    for (std::size_t c = 0; c < columns; ++c) shown = shown || !run(c).recording.samples.empty();
    const std::string load = domain::write_number(scenario.loads_kg[r]) + " kg";
    row(
        shown ? fmt::format("<tr data-group='{}'><th scope='row'>{}</th>", group, link_html(group, load))
              : fmt::format("<tr><th scope='row'>{}</th>", load),
        [&](std::size_t c) {
          return run(c).failure.empty() ? std::optional(run(c).metrics.rmse) : std::nullopt;
        },
        [&](std::size_t c) { return run(c).failure.empty() ? output::extrapolation_mark(run(c)) : ""; });
    if (shown) ++group;
  }
  if (scenario.loads_kg.size() > 1)
    row(
        "<tr class='mean'><th scope='row'>mean</th>",
        [&](std::size_t c) {
          const auto& rmse = comparison.spreads[c].rmse;
          return rmse ? std::optional(rmse->mean) : std::nullopt;
        },
        [](std::size_t) { return std::string(); });
  html += "</tbody></table>\n";
  if (marked)
    html +=
        "<p class='small'>* extrapolated: load or target outside the calibrated range; + load taken as the "
        "end of that range</p>\n";
  return html;
}

/// How long each run was at a limit of its current; empty where none was for 1 % of its time.
std::string limits_table(const domain::Scenario& scenario, const run::Comparison& comparison) {
  const std::size_t columns = scenario.controllers.size();
  std::string head, rows;
  for (const auto& one : scenario.controllers)
    head += "<th scope='col'>" + escaped(controllers::name_of(one)) + "</th>";
  double most = 0.0;
  for (std::size_t r = 0; r < scenario.loads_kg.size(); ++r) {
    rows += "<tr><th scope='row'>" + domain::write_number(scenario.loads_kg[r]) + " kg</th>";
    for (std::size_t c = 0; c < columns; ++c) {
      const run::TrackedRun& run = comparison.runs[r * columns + c];
      const bool told = run.limits && run.failure.empty();
      const double share = told ? run::share_at_limit(run) : 0.0;
      most = std::max(most, share);
      rows += told ? fmt::format("<td>{:.0f}</td>", 100.0 * share) : "<td>-</td>";
    }
    rows += "</tr>\n";
  }
  if (most < 0.01) return "";
  return fmt::format(
      "<details class='limits'><summary>Controllers stood at a limit of their current for up to {:.0f} % of "
      "the time</summary>\n<table><caption>Share of the time at the lowest or highest current, in "
      "%</caption>\n<thead><tr><th scope='col'>load</th>{}</tr></thead>\n<tbody>\n{}</tbody></table>\n"
      "</details>\n",
      100.0 * most, head, rows);
}

Group group_of(const domain::Scenario& scenario, const run::Comparison& comparison, std::size_t r) {
  const std::size_t columns = scenario.controllers.size();
  const double load_kg = scenario.loads_kg[r];
  const plant::Plant plant(scenario.rig, load_kg);
  const auto* target = &comparison.target;
  Group group{.name = domain::write_number(load_kg) + " kg", .load_kg = load_kg, .ticks = target->size()};
  group.given = {{"given_contraction_ratio", [target](std::size_t k) { return (*target)[k]; }},
                 {"weight", [weight_N = plant.weight_N()](std::size_t) { return weight_N; }}};
  for (std::size_t c = 0; c < columns; ++c) {
    const run::TrackedRun& run = comparison.runs[r * columns + c];
    const auto* rows = &run.recording.samples;
    if (rows->empty()) continue;
    Run shown{.name = run.controller, .style = c, .ticks = rows->size()};
    shown.quantities = quantities_of(run.recording, scenario.rig);
    shown.quantities.push_back({"error", [rows, target](std::size_t k) {
                                  return (*rows)[k].state.joint.contraction_ratio - (*target)[k];
                                }});
    group.runs.push_back(std::move(shown));
  }
  return group;
}

}  // namespace

std::string report_html(const domain::Scenario& scenario, const run::Comparison& comparison) {
  Contents contents{.title = scenario.name,
                    .about = fmt::format("Simulated: {}, {:g} s each", loads_text(scenario.loads_kg.size()),
                                         scenario.duration_s),
                    .warnings = comparison.warnings,
                    .sentence = sentence(scenario, comparison),
                    .table = table(scenario, comparison) + limits_table(scenario, comparison),
                    .details = output::table_of(scenario, comparison),
                    .beside = std::string(beside_runs),
                    .chapters = {robustness(scenario, comparison)},
                    .rig = scenario.rig,
                    .gauge = scenario.rig.gauge.fitted,
                    .plots = plots_of(scenario.rig, {.title = "Target and contraction",
                                                     .given = "Target",
                                                     .error = "Error: contraction less target"}),
                    .loops = loops_of({})};
  for (std::size_t r = 0; r < scenario.loads_kg.size(); ++r)
    if (auto group = group_of(scenario, comparison, r); !group.runs.empty())
      contents.groups.push_back(std::move(group));
  return html_of(contents);
}

}  // namespace mckibben::report
