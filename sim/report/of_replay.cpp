// The report of `replay`: how far the simulation is from what was measured, a group for each run.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include <sim/input/number.hpp>
#include <sim/output/svg.hpp>
#include <sim/output/table.hpp>
#include <sim/report/html.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/report.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::report {
namespace {

using output::escaped;

std::string sentence(const input::Dataset& dataset, const std::vector<run::ReplayedRun>& runs) {
  const double length_mm = 1e3 * dataset.rig.muscle.rest_length_m;
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
  std::string text = fmt::format(
      "Simulated and measured height of the load differ by {:.3f} mm (contraction ratio {:.6f}), root "
      "mean square over {} run{}",
      rmse * length_mm, rmse, ended, ended == 1 ? "" : "s");
  text += ended == 1 ? "." : fmt::format("; by most in {}: {:.3f} mm.", worst->id, worst->rmse * length_mm);
  if (ended < runs.size())
    text += fmt::format(" {} of {} runs have no result.", runs.size() - ended, runs.size());
  return text;
}

std::string table(const input::Dataset& dataset, const std::vector<run::ReplayedRun>& runs) {
  const double length_mm = 1e3 * dataset.rig.muscle.rest_length_m;
  const bool gauge =
      std::any_of(runs.begin(), runs.end(), [](const auto& run) { return run.pressure_rmse_Pa; });
  std::string html = fmt::format(
      "<table><caption>Simulated less measured height</caption>\n<thead><tr><th scope='col'>run</th><th "
      "scope='col'>load, kg</th><th scope='col'>rmse, mm</th><th scope='col'>largest, mm</th><th "
      "scope='col'>mean, mm</th>{}</tr></thead>\n<tbody>\n",
      gauge ? "<th scope='col'>pressure rmse, bar</th>" : "");
  std::size_t group = 0;
  for (const auto& run : runs) {
    const bool shown = !run.recording.samples.empty();
    html += fmt::format("<tr{}><th scope='row'>{}</th><td>{}</td>",
                        shown ? fmt::format(" data-group='{}'", group++) : "", escaped(run.id),
                        input::write_number(run.load_kg));
    if (!run.failure.empty()) {
      html += fmt::format("<td colspan='{}'>no result</td></tr>\n", gauge ? 4 : 3);
      continue;
    }
    html += fmt::format("<td>{:.3f}</td><td>{:.3f}</td><td>{:+.3f}</td>", run.rmse * length_mm,
                        run.largest_error * length_mm, run.mean_error * length_mm);
    if (gauge)
      html +=
          run.pressure_rmse_Pa ? fmt::format("<td>{:.4f}</td>", *run.pressure_rmse_Pa / 1e5) : "<td>-</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table>\n";
}

Group group_of(const input::Dataset& dataset, const input::Run& measured, const run::ReplayedRun& run) {
  const plant::Plant plant(dataset.rig, run.load_kg);
  const auto* rows = &run.recording.samples;
  Group group{.name = fmt::format("{}, {} kg", run.id, input::write_number(run.load_kg)),
              .load_kg = run.load_kg,
              .ticks = measured.contraction_ratio.size()};
  group.given = {{"given_contraction", [&measured](std::size_t k) { return measured.contraction_ratio[k]; }},
                 {"weight", [weight_N = plant.weight_N()](std::size_t) { return weight_N; }}};
  if (measured.muscle_pressure_Pa)
    group.given.push_back(
        {"given_pressure", [&measured](std::size_t k) { return (*measured.muscle_pressure_Pa)[k] / 1e5; }});
  Run shown{.name = "simulated", .ticks = rows->size()};
  shown.quantities = quantities_of(run.recording, plant);
  shown.quantities.push_back(
      {"error", [rows, &measured, per_count = run::contraction_per_count(dataset.rig)](std::size_t k) {
         return static_cast<double>((*rows)[k].counts) * per_count - measured.contraction_ratio[k];
       }});
  group.runs.push_back(std::move(shown));
  return group;
}

}  // namespace

std::string report_html(const input::Dataset& dataset, const std::vector<run::ReplayedRun>& runs) {
  const std::string name =
      std::filesystem::absolute(dataset.path).lexically_normal().parent_path().filename().string();
  const bool gauge = std::any_of(dataset.runs.begin(), dataset.runs.end(), [](const auto& measured) {
    return measured.muscle_pressure_Pa.has_value();
  });
  Contents contents{
      .title = "Replay of " + name,
      .about = fmt::format("{} measured runs, simulated with their recorded currents", runs.size()),
      .sentence = sentence(dataset, runs),
      .table = table(dataset, runs),
      .details = output::table_of(dataset, runs),
      .beside = std::string(beside_runs),
      .rig = dataset.rig,
      .plots = plots_for(dataset.rig, "Contraction, measured and simulated", "Measured",
                         "Error: simulated less measured, both as counted", gauge),
      .loops = loops()};
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (!runs[i].recording.samples.empty())
      contents.groups.push_back(group_of(dataset, dataset.runs[i], runs[i]));
  return html_of(contents);
}

}  // namespace mckibben::report
