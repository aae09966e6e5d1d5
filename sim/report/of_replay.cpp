// The report of `replay`: how far the simulation is from what was measured, a group for each run; a pair has
// lines for either muscle.
#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/replay_results.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/html.hpp>
#include <sim/report/length.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/report.hpp>
#include <sim/report/sheet.hpp>
#include <sim/report/still.hpp>
#include <sim/report/tables.hpp>

namespace mckibben::report {
namespace {

using output::escaped;

/// The readings of a run beside their simulation, under the keys of its plots.
void add_readings(Group& group, Run& shown, const domain::Run& measured, const plant::Rig& rig,
                  const run::Recording& recording) {
  for (const run::Compared& one : run::compared(measured, rig, recording)) {
    const double factor = one.unit == "rad" ? in_degrees : 1.0;
    const bool position = one.reading == "contraction" || one.reading == "angle";
    const std::string key = one.reading == "contraction" ? "contraction_ratio" : one.reading;
    group.given.push_back(
        {"given_" + key, [factor, at = one.measured](std::size_t k) { return factor * at(k); }});
    shown.quantities.push_back(
        {position ? "error" : key + "_error", [factor, is = one.simulated, at = one.measured](std::size_t k) {
           return factor * (is(k) - at(k));
         }});
  }
}

bool drawn(const run::ReplayedRun& run) {
  return !run.recording.samples.empty();
}

/// In the order in which the page shows them: as measured, or of many the worst first.
std::vector<std::size_t> order(const std::vector<run::ReplayedRun>& runs) {
  std::vector<std::size_t> all(runs.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (runs.size() <= many_runs) return all;
  const auto badness = [&](std::size_t i) { return runs[i].gaps.empty() ? -1.0 : runs[i].gaps.front().rmse; };
  std::ranges::stable_sort(all, std::greater(), badness);
  return all;
}

std::string gap_row(const run::Gap& gap, const plant::Rig& rig) {
  const bool height = output::is_height(gap);
  const auto cell = [&](double value, bool sign) {
    return height ? length_html(value, rig, 3, sign) : output::gap_number(value, sign);
  };
  const std::string unit = height ? length_unit_html() : gap.unit;
  return fmt::format("<td>{}, {}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", gap.reading, unit,
                     cell(gap.rmse, false), cell(gap.largest, false), cell(gap.mean, true), gap.rows);
}

/// A row for each reading of each run; of many runs the loads first.
std::string gaps_table(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs) {
  std::string html =
      "<table><caption>Simulated less measured</caption>\n<thead><tr><th scope='col'>run</th><th "
      "scope='col'>load, kg</th><th scope='col'>reading</th><th scope='col'>rmse</th><th "
      "scope='col'>largest</th><th scope='col'>mean</th><th scope='col'>rows</th></tr></thead>\n<tbody>\n";
  std::vector<RunError> judged;
  std::size_t group = 0;
  for (const std::size_t i : order(runs)) {
    const run::ReplayedRun& run = runs[i];
    const std::string link = drawn(run) ? link_html(group, run.id) : escaped(run.id);
    const std::string head = fmt::format("<tr{}><th scope='row'>{}</th><td>{}</td>",
                                         drawn(run) ? fmt::format(" data-group='{}'", group) : "", link,
                                         run.load_kg > 0.0 ? domain::write_kg(run.load_kg) : "-");
    if (run.gaps.empty())
      html += head +
              fmt::format("<td colspan='5'>{}</td></tr>\n", run.failure.empty() ? "no reading" : "no result");
    for (const run::Gap& gap : run.gaps) html += head + gap_row(gap, dataset.rig);
    if (const run::Gap* height = run.gap("contraction"); height != nullptr && run.load_kg > 0.0)
      judged.push_back({run.id, run.load_kg, height->rmse, group});
    if (drawn(run)) ++group;
  }
  html += "</tbody></table>\n";
  if (runs.size() <= many_runs || judged.empty()) return html;
  return by_load_html(judged, dataset.rig) +
         fmt::format("<details><summary>All {} runs, the worst first</summary>\n{}</details>\n", runs.size(),
                     html);
}

std::string sentence(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs) {
  const run::Gap* worst = nullptr;
  const run::ReplayedRun* of = nullptr;
  for (const auto& run : runs)
    if (!run.gaps.empty() && (worst == nullptr || run.gaps.front().rmse > worst->rmse))
      worst = &run.gaps.front(), of = &run;
  if (worst == nullptr) return "Nothing was read that a simulation could be compared with.";
  const bool height = output::is_height(*worst);
  return fmt::format(
      "Simulated and measured {} differ by {}, root mean square, where they differ most: in {}.",
      height                                ? "height of the load"
      : worst->reading == "muscle_pressure" ? "pressure"
                                            : worst->reading,
      height ? full_length_html(worst->rmse, dataset.rig)
             : output::gap_number(worst->rmse) + " " + worst->unit,
      escaped(of->id));
}

Contents contents_of(const plant::Rig& rig, const run::Driven& driven) {
  Contents contents;
  contents.rig = rig;
  if (driven.length) contents.rig.mechanics = plant::HeldLength{};
  contents.lengths = !rig.has_angle();
  contents.beside = std::string(beside_runs);
  contents.loops = loops_of(rig, driven);
  return contents;
}

/// Plots, loops and runs of the page.
Contents drawn_of(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs) {
  const auto measured = [&](const char* reading) {
    return std::any_of(runs.begin(), runs.end(), [&](const auto& run) {
      return std::any_of(run.gaps.begin(), run.gaps.end(),
                         [&](const auto& gap) { return gap.reading == reading; });
    });
  };
  const auto first = std::ranges::find_if(runs, drawn);
  const run::Driven driven = first == runs.end() ? run::Driven{} : first->recording.driven;
  Contents contents = contents_of(dataset.rig, driven);
  contents.gauge = measured("muscle_pressure") || driven.pressure[0] == plant::GivenPressure::muscle;
  constexpr auto none = plant::GivenPressure::none;
  const bool angle = dataset.rig.has_angle(), position = measured(angle ? "angle" : "contraction");
  const std::string title = angle ? "Joint angle" : "Contraction";
  contents.plots = plots_of(
      dataset.rig, {.driven = driven,
                    .key = angle ? "angle" : "contraction_ratio",
                    .title = title,
                    .given = position ? "measured" : "",
                    .error = position ? title + ": simulated less measured" : "",
                    .commands = driven.pressure[0] == none || (driven.pair && driven.pressure[1] == none),
                    .pressure = measured("muscle_pressure"),
                    .valve_pressure = measured("valve_pressure") || measured("valve_pressure_1") ||
                                      measured("valve_pressure_2"),
                    .force = measured("force")});
  for (const std::size_t i : order(runs)) {
    const run::ReplayedRun& run = runs[i];
    if (!drawn(run)) continue;
    const domain::Run& measured_run = dataset.runs[i];
    Group group{
        .name = run.load_kg > 0.0 ? fmt::format("{}, {} kg", run.id, domain::write_kg(run.load_kg)) : run.id,
        .load_kg = run.load_kg,
        .ticks = run.recording.samples.size()};
    if (measured_run.measured)
      for (const run::Sample& row : run.recording.samples) group.time_s.push_back(row.time_s);
    if (run.load_kg > 0.0)
      group.given.push_back({"weight", [weight_N = plant::Plant(dataset.rig, run.load_kg).weight_N()](
                                           std::size_t) { return weight_N; }});
    if (const run::Gap* height = run.gap("contraction")) group.rmse = height->rmse;
    Run shown{.name = "simulated", .ticks = group.ticks};
    shown.quantities = quantities_of(run.recording, dataset.rig);
    add_readings(group, shown, measured_run, dataset.rig, run.recording);
    group.runs.push_back(std::move(shown));
    contents.groups.push_back(std::move(group));
  }
  return contents;
}

}  // namespace

std::string report_html(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs,
                        const std::vector<std::string>& warnings) {
  Contents contents = drawn_of(dataset, runs);
  contents.title = "Replay of " + output::name_of(dataset);
  contents.about = fmt::format("{} measured run{}, simulated with what drove them", runs.size(),
                               runs.size() == 1 ? "" : "s");
  contents.warnings = warnings;
  contents.sentence = sentence(dataset, runs);
  contents.table = gaps_table(dataset, runs);
  contents.details = output::table_of(dataset, runs, warnings);
  return html_of(contents);
}

std::string tracking_svg(const domain::Dataset& dataset, const std::vector<run::ReplayedRun>& runs) {
  const Contents all = drawn_of(dataset, runs);
  std::vector<Picture> panels;
  for (const Group& group : all.groups)
    panels.push_back(
        {group.name, still_svg(group, all.plots.front(), all.rig, ticks_looked_at(runs.size()))});
  if (panels.empty()) return "";
  const Plot& drawn = all.plots.front();
  return sheet_svg(panels, still_width, still_height, keys_of(all.groups.front(), drawn.lines.front().given),
                   drawn.title);
}

}  // namespace mckibben::report
