// The report of `replay`: how far the simulation is from what was measured, a group for each run.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/output/svg.hpp>
#include <sim/output/table.hpp>
#include <sim/report/by_load.hpp>
#include <sim/report/html.hpp>
#include <sim/report/length.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/report.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::report {
namespace {

using output::escaped;

std::string sentence(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs) {
  const run::ReplayedRun* worst = nullptr;
  double squares = 0.0;
  std::size_t rows = 0, ended = 0;
  for (const auto& run : runs) {
    if (!run.failure.empty()) continue;
    const auto count = run.recording.samples.size();
    squares += run.rmse * run.rmse * static_cast<double>(count);
    rows += count;
    ++ended;
    if (worst == nullptr || run.rmse > worst->rmse) worst = &run;
  }
  if (worst == nullptr) return "No run could be simulated to its end.";
  const double rmse = std::sqrt(squares / static_cast<double>(rows));
  if (rmse == 0.0)
    return fmt::format("Simulated and measured height agree in every count of all {} runs.", ended);
  std::string text =
      fmt::format("Simulated and measured height of the load differ by {}, root mean square over {} run{}",
                  full_length_html(rmse, dataset.rig), ended, ended == 1 ? "" : "s");
  text += ended == 1 ? "."
                     : fmt::format("; by most in {}: {}.", escaped(worst->id),
                                   full_length_html(worst->rmse, dataset.rig));
  if (ended < runs.size())
    text += fmt::format(" {} of {} runs have no result.", runs.size() - ended, runs.size());
  return text;
}

/// In the order in which the page shows them: as measured, or of many the worst first, and last those
/// without a result.
std::vector<std::size_t> order(const std::vector<run::ReplayedRun>& runs) {
  std::vector<std::size_t> all(runs.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (runs.size() <= many_runs) return all;
  const auto badness = [&](std::size_t i) { return runs[i].failure.empty() ? runs[i].rmse : -1.0; };
  std::stable_sort(all.begin(), all.end(),
                   [&](std::size_t a, std::size_t b) { return badness(a) > badness(b); });
  return all;
}

bool drawn(const run::ReplayedRun& run) {
  return !run.recording.samples.empty();
}

std::string row(const run::ReplayedRun& run, std::size_t group, const plant::Rig& rig, bool gauge) {
  std::string html =
      drawn(run) ? fmt::format("<tr data-group='{}'><th scope='row'>{}</th>", group, link_html(group, run.id))
                 : "<tr><th scope='row'>" + escaped(run.id) + "</th>";
  html += "<td>" + domain::write_number(run.load_kg) + "</td>";
  if (!run.failure.empty())
    return html + fmt::format("<td colspan='{}'>no result</td></tr>\n", gauge ? 4 : 3);
  html += fmt::format("<td>{}</td><td>{}</td><td>{}</td>", length_html(run.rmse, rig),
                      length_html(run.largest_error, rig), length_html(run.mean_error, rig, 3, true));
  if (gauge)
    html += run.pressure_rmse_Pa ? fmt::format("<td>{:.4f}</td>", *run.pressure_rmse_Pa / 1e5) : "<td>-</td>";
  return html + "</tr>\n";
}

/// Every run; of many the loads first.
std::string table(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs) {
  const bool gauge =
      std::any_of(runs.begin(), runs.end(), [](const auto& run) { return run.pressure_rmse_Pa; });
  std::string html = fmt::format(
      "<table><caption>Simulated less measured height</caption>\n<thead><tr><th scope='col'>run</th><th "
      "scope='col'>load, kg</th><th scope='col'>rmse, {0}</th><th scope='col'>largest, {0}</th><th "
      "scope='col'>mean, {0}</th>{1}</tr></thead>\n<tbody>\n",
      length_unit_html(), gauge ? "<th scope='col'>pressure rmse, bar</th>" : "");
  std::vector<Judged> judged;
  std::size_t group = 0;
  for (const std::size_t i : order(runs)) {
    html += row(runs[i], group, dataset.rig, gauge);
    if (runs[i].failure.empty()) judged.push_back({runs[i].id, runs[i].load_kg, runs[i].rmse, group});
    if (drawn(runs[i])) ++group;
  }
  html += "</tbody></table>\n";
  if (runs.size() <= many_runs) return html;
  return by_load_html(judged, dataset.rig) +
         fmt::format("<details><summary>All {} runs, the worst first</summary>\n{}</details>\n", runs.size(),
                     html);
}

Group group_of(const domain::Dataset& dataset, const domain::Run& measured, const run::ReplayedRun& run) {
  const plant::Plant plant(dataset.rig, run.load_kg);
  const auto* rows = &run.recording.samples;
  Group group{.name = fmt::format("{}, {} kg", run.id, domain::write_number(run.load_kg)),
              .load_kg = run.load_kg,
              .ticks = measured.contraction_ratio.size()};
  group.given = {
      {"given_contraction_ratio", [&measured](std::size_t k) { return measured.contraction_ratio[k]; }},
      {"weight", [weight_N = plant.weight_N()](std::size_t) { return weight_N; }}};
  if (run.failure.empty()) group.rmse = run.rmse;
  if (measured.muscle_pressure_Pa)
    group.given.push_back({"given_muscle_pressure",
                           [&measured](std::size_t k) { return (*measured.muscle_pressure_Pa)[k] / 1e5; }});
  Run shown{.name = "simulated", .ticks = rows->size()};
  shown.quantities = quantities_of(run.recording, dataset.rig);
  shown.quantities.push_back({"error", [rows, &measured](std::size_t k) {
                                return (*rows)[k].read_ratio - measured.contraction_ratio[k];
                              }});
  if (measured.muscle_pressure_Pa)
    shown.quantities.push_back(
        {"muscle_pressure_error", [rows, &measured, effects = dataset.rig.effects](std::size_t k) {
           const double shown_Pa = effects.shown_Pa((*rows)[k].state.side.muscle_pressure_Pa);
           return (shown_Pa - (*measured.muscle_pressure_Pa)[k]) / 1e5;
         }});
  group.runs.push_back(std::move(shown));
  return group;
}

}  // namespace

std::string report_html(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs,
                        const std::vector<std::string>& warnings) {
  const std::string name =
      std::filesystem::absolute(dataset.path).lexically_normal().parent_path().filename().string();
  const bool gauge = std::any_of(dataset.runs.begin(), dataset.runs.end(), [](const auto& measured) {
    return measured.muscle_pressure_Pa.has_value();
  });
  Contents contents{
      .title = "Replay of " + name,
      .about = fmt::format("{} measured runs, simulated with their recorded currents", runs.size()),
      .warnings = warnings,
      .sentence = sentence(dataset, runs),
      .table = table(dataset, runs),
      .details = output::table_of(dataset, runs),
      .beside = std::string(beside_runs),
      .rig = dataset.rig,
      .gauge = gauge,
      .plots = plots_of(dataset.rig, {.title = "Contraction, measured and simulated",
                                      .given = "Measured",
                                      .error = "Error: simulated less measured, both as counted",
                                      .pressure = gauge}),
      .loops = loops_of({})};
  for (const std::size_t i : order(runs))
    if (drawn(runs[i])) contents.groups.push_back(group_of(dataset, dataset.runs[i], runs[i]));
  return html_of(contents);
}

}  // namespace mckibben::report
