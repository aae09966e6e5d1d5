// Reports of replays of data with a clock of their own. A group for each run; a pair has lines for either
// muscle.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/driven_results.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/driven_quantities.hpp>
#include <sim/report/html.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/report.hpp>

namespace mckibben::report {
namespace {

using output::escaped;

/// The readings of a run beside their simulation, under the keys of its plots.
void add_readings(Group& group, Run& shown, const domain::Measurement& measured, const domain::RigFile& rig,
                  const run::Recording& recording) {
  for (const run::Compared& one : run::compared(measured, rig, recording)) {
    const double factor = one.unit == "rad" ? in_degrees : 1.0;
    const std::string key = one.reading == "force" ? "cord_force" : one.reading;
    group.given.push_back(
        {"given_" + key, [factor, at = one.measured](std::size_t k) { return factor * at(k); }});
    shown.quantities.push_back({key + "_error", [factor, is = one.simulated, at = one.measured](
                                                    std::size_t k) { return factor * (is(k) - at(k)); }});
  }
}

std::string gaps_table(const std::vector<run::StampedRun>& runs) {
  std::string html =
      "<table><caption>Simulated less measured</caption>\n<thead><tr><th scope='col'>run</th><th "
      "scope='col'>reading</th><th scope='col'>rmse</th><th scope='col'>largest</th><th "
      "scope='col'>mean</th><th scope='col'>rows</th></tr></thead>\n<tbody>\n";
  std::size_t group = 0;
  for (const auto& run : runs) {
    const bool drawn = !run.recording.samples.empty();
    const auto head = [&] {
      return drawn ? fmt::format("<tr data-group='{}'><th scope='row'>{}</th>", group, escaped(run.id))
                   : fmt::format("<tr><th scope='row'>{}</th>", escaped(run.id));
    };
    if (run.gaps.empty())
      html += head() +
              fmt::format("<td colspan='5'>{}</td></tr>\n", run.failure.empty() ? "no reading" : "no result");
    for (const run::Gap& gap : run.gaps)
      html += head() + fmt::format("<td>{}{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                                   gap.reading, gap.unit == "1" ? "" : ", " + gap.unit,
                                   output::gap_number(gap.rmse), output::gap_number(gap.largest),
                                   output::gap_number(gap.mean, true), gap.rows);
    if (drawn) ++group;
  }
  return html + "</tbody></table>\n";
}

std::string sentence(const std::vector<run::StampedRun>& runs) {
  const run::Gap* worst = nullptr;
  const run::StampedRun* of = nullptr;
  for (const auto& run : runs)
    if (!run.gaps.empty() && (worst == nullptr || run.gaps.front().rmse > worst->rmse))
      worst = &run.gaps.front(), of = &run;
  if (worst == nullptr) return "Nothing was read that a simulation could be compared with.";
  return fmt::format(
      "Simulated and measured {} differ by {}{}, root mean square, where they differ most: in {}.",
      worst->reading == "muscle_pressure" ? "pressure" : worst->reading, output::gap_number(worst->rmse),
      worst->unit == "1" ? "" : " " + worst->unit, escaped(of->id));
}

Contents contents_of(const domain::RigFile& rig, const run::Driven& driven) {
  Contents contents;
  contents.rig = rig;
  contents.mechanics = rig.mechanics;
  if (driven.length) contents.mechanics = plant::HeldLength{};
  contents.lengths = !driven.pair;
  contents.beside = std::string(beside_runs);
  contents.loops = driven.pair ? pair_loops() : single_loops();
  return contents;
}

}  // namespace

std::string report_html(const domain::Dataset& dataset, const std::vector<run::StampedRun>& runs,
                        const std::vector<std::string>& warnings) {
  const auto measured = [&](const char* reading) {
    return std::any_of(runs.begin(), runs.end(), [&](const auto& run) {
      return std::any_of(run.gaps.begin(), run.gaps.end(),
                         [&](const auto& gap) { return gap.reading == reading; });
    });
  };
  const auto drawn =
      std::find_if(runs.begin(), runs.end(), [](const auto& run) { return !run.recording.samples.empty(); });
  const run::Driven driven = drawn == runs.end() ? run::Driven{} : drawn->recording.driven;
  Contents contents = contents_of(dataset.rig, driven);
  contents.title = "Replay of " + output::name_of(dataset);
  contents.about = fmt::format("{} measured run{}, simulated with what drove them", runs.size(),
                               runs.size() == 1 ? "" : "s");
  contents.warnings = warnings;
  contents.sentence = sentence(runs);
  contents.table = gaps_table(runs);
  contents.details = output::table_of(dataset, runs, warnings);
  contents.plots = driven.pair
                       ? pair_plots(measured("angle") ? measured_beside() : Beside{},
                                    !driven.pressure[0] || !driven.pressure[1])
                       : single_plots(measured("contraction"), measured("force"), !driven.pressure[0]);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const run::StampedRun& run = runs[i];
    if (run.recording.samples.empty()) continue;
    const domain::Measurement& given = *dataset.runs[i].measured;
    Group group{.name = run.load_kg > 0.0
                            ? fmt::format("{}, {} kg", run.id, domain::write_number(run.load_kg))
                            : run.id,
                .load_kg = run.load_kg,
                .ticks = run.recording.samples.size(),
                .time_s = given.time_s};
    group.time_s.resize(group.ticks);
    Run shown{.name = "simulated", .ticks = group.ticks};
    shown.quantities =
        driven.pair ? pair_quantities(dataset.rig, run.recording) : single_quantities(run.recording);
    add_readings(group, shown, given, dataset.rig, run.recording);
    group.runs.push_back(std::move(shown));
    contents.groups.push_back(std::move(group));
  }
  return html_of(contents);
}

}  // namespace mckibben::report
