// The report of `run` of a pair: a group for each run under given currents; of controllers one for each
// target with each load in the hand, in which they are compared.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/driven_results.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/by_load.hpp>
#include <sim/report/html.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/report.hpp>

namespace mckibben::report {
namespace {

using output::escaped;

std::string current_sentence(const run::PairRun& run) {
  if (!run.failure.empty()) return fmt::format("{}: no result. ", escaped(run.name));
  return fmt::format(
      "{}: the joint turns between {}° and {}°, the cords carry {:.0f} to {:.0f} N and {:.0f} to {:.0f} N. ",
      escaped(run.name), output::rounded(in_degrees * run.angle_rad.low, 1),
      output::rounded(in_degrees * run.angle_rad.high, 1), run.cord_force_N.low, run.cord_force_N.high,
      run.opposite_cord_force_N.low, run.opposite_cord_force_N.high);
}

/// Mean of the angle's error of a controller over its runs with a result [deg]; none if there is none.
std::optional<double> mean_rmse_deg(const run::PairRuns& all, std::size_t controller) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const auto& run : all.runs)
    if (run.followed && run.followed->controller == controller && run.failure.empty())
      sum += in_degrees * run.followed->metrics.rmse, ++count;
  return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

std::string sentence(const domain::PairScenario& scenario, const run::PairRuns& all) {
  std::string text;
  for (std::size_t c = 0; c < scenario.controllers.size(); ++c)
    if (const auto rmse = mean_rmse_deg(all, c))
      text += fmt::format("{}: root mean square error of the angle {:.2f}°, the mean over its runs. ",
                          escaped(name_of(scenario.controllers[c])), *rmse);
  for (const auto& run : all.runs)
    if (!run.followed) text += current_sentence(run);
  return text;
}

struct Place {
  std::size_t target;
  double load_kg;
};

std::string name_at(const domain::PairScenario& scenario, const Place& at) {
  const std::string& name = scenario.targets[at.target].name;
  return scenario.hand.loads_kg.size() == 1 && at.load_kg == 0.0
             ? name
             : fmt::format("{}, {} kg in the hand", name, domain::write_number(at.load_kg));
}

/// The runs of one target with one load, in the order of the controllers.
std::vector<const run::PairRun*> runs_at(const run::PairRuns& all, const Place& at) {
  std::vector<const run::PairRun*> runs;
  for (const auto& run : all.runs)
    if (run.followed && run.followed->target == at.target && run.followed->load_kg == at.load_kg)
      runs.push_back(&run);
  return runs;
}

std::vector<Place> places(const domain::PairScenario& scenario) {
  std::vector<Place> all;
  for (std::size_t t = 0; t < scenario.targets.size(); ++t)
    for (const double load_kg : scenario.hand.loads_kg) all.push_back({t, load_kg});
  return all;
}

bool is_drawn(const std::vector<const run::PairRun*>& runs) {
  return std::any_of(runs.begin(), runs.end(),
                     [](const auto* run) { return !run->recording.samples.empty(); });
}

/// Errors of the angle in deg, a row for each target and load; the smallest of a row is marked.
std::string table(const domain::PairScenario& scenario, const run::PairRuns& all, std::size_t group) {
  if (scenario.controllers.empty()) return "";
  std::string html =
      "<table><caption>Root mean square error of the joint angle, deg; the smallest of each row is bold"
      "</caption>\n<thead><tr><th scope='col'>target</th>";
  for (const auto& one : scenario.controllers) html += "<th scope='col'>" + escaped(name_of(one)) + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const Place& at : places(scenario)) {
    const auto runs = runs_at(all, at);
    double least = std::numeric_limits<double>::infinity();
    for (const auto* run : runs)
      if (run->failure.empty()) least = std::min(least, run->followed->metrics.rmse);
    const std::string name = name_at(scenario, at);
    html += is_drawn(runs)
                ? fmt::format("<tr data-group='{}'><th scope='row'>{}</th>", group, link_html(group, name))
                : fmt::format("<tr><th scope='row'>{}</th>", escaped(name));
    for (const auto* run : runs)
      html +=
          run->failure.empty()
              ? fmt::format("<td{}>{:.2f}</td>",
                            runs.size() > 1 && run->followed->metrics.rmse == least ? " class='best'" : "",
                            in_degrees * run->followed->metrics.rmse)
              : "<td>no result</td>";
    html += "</tr>\n";
    if (is_drawn(runs)) ++group;
  }
  return html + "</tbody></table>\n";
}

Run shown(const std::string& name, std::size_t style, const run::PairRun& run, const domain::RigFile& rig) {
  return {.name = name,
          .style = style,
          .ticks = run.recording.samples.size(),
          .quantities = quantities_of(run.recording, rig)};
}

Group group_of(const domain::PairScenario& scenario, const run::PairRuns& all, const Place& at) {
  const auto runs = runs_at(all, at);
  const run::JointFollowed& wanted = *runs.front()->followed;
  const auto* angle = &wanted.angle_rad;
  const auto* stiffness = &wanted.stiffness_N_m_per_rad;
  Group group{.name = name_at(scenario, at), .load_kg = at.load_kg, .ticks = angle->size()};
  group.given.push_back({"given_angle", [angle](std::size_t k) { return in_degrees * (*angle)[k]; }});
  if (!stiffness->empty())
    group.given.push_back({"given_stiffness", [stiffness](std::size_t k) { return (*stiffness)[k]; }});
  for (std::size_t c = 0; c < runs.size(); ++c) {
    const auto* rows = &runs[c]->recording.samples;
    if (rows->empty()) continue;
    Run run = shown(name_of(scenario.controllers[c]), c, *runs[c], scenario.rig);
    run.quantities.push_back({"error", [rows, angle](std::size_t k) {
                                return in_degrees * ((*rows)[k].angle_rad - (*angle)[k]);
                              }});
    group.runs.push_back(std::move(run));
  }
  return group;
}

}  // namespace

std::string report_html(const domain::PairScenario& scenario, const run::PairRuns& all,
                        const std::vector<std::string>& warnings) {
  Contents contents{
      .title = scenario.name,
      .about = fmt::format("Simulated: two muscles on one wheel, {:g} s each", scenario.duration_s),
      .warnings = warnings,
      .sentence = sentence(scenario, all),
      .details = output::table_of(scenario, all, warnings),
      .beside = std::string(beside_runs),
      .lengths = false,
      .rig = scenario.rig,
      .mechanics = scenario.rig.mechanics,
      .plots =
          plots_of(scenario.rig, {.driven = {.pair = true},
                                  .key = "angle",
                                  .title = "Joint angle",
                                  .given = scenario.targets.empty() ? "" : "target",
                                  .error = scenario.targets.empty() ? "" : "Joint angle: angle less target"}),
      .loops = loops_of({.pair = true})};
  for (const Place& at : places(scenario))
    if (is_drawn(runs_at(all, at))) contents.groups.push_back(group_of(scenario, all, at));
  contents.table = table(scenario, all, 0);
  for (const auto& run : all.runs) {
    if (run.followed || run.recording.samples.empty()) continue;
    Group group{.name = run.name, .ticks = run.recording.samples.size()};
    group.runs.push_back(shown("simulated", 0, run, scenario.rig));
    contents.groups.push_back(std::move(group));
  }
  return html_of(contents);
}

}  // namespace mckibben::report
