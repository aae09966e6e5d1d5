// The report of `diagnose`: the verdict and the gap, the story in chapters, and every run as measured and as
// three rigs make of it, those held out first.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <sim/output/diagnosis_results.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/diagnosis_chapters.hpp>
#include <sim/report/html.hpp>
#include <sim/report/length.hpp>
#include <sim/report/opening.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/report.hpp>
#include <sim/report/tables.hpp>

namespace mckibben::report {
namespace {

using diagnose::Diagnosis;
using diagnose::RunGap;
using run::ReplayedRun;

/// What is known where the diagnosis ended before its runs: measured, and the rig as described.
std::vector<RunGap> as_described(const domain::Dataset& data, const std::vector<ReplayedRun>& nominal) {
  std::vector<RunGap> runs;
  for (std::size_t i = 0; i < std::min(data.runs.size(), nominal.size()); ++i) {
    runs.push_back({.id = data.runs[i].id, .load_kg = data.runs[i].load_kg});
    runs.back().measured = data.runs[i].judged().values;
    const plant::Signal& read = plant::signal_of(output::words_of(data.judged()).signal);
    for (const auto& sample : nominal[i].recording.samples)
      runs.back().nominal.push_back(read.value(sample, 0));
  }
  return runs;
}

/// Those held out, then those of the fit, then those left out; of many the worst first in each.
std::vector<const RunGap*> ordered(const std::vector<RunGap>& all, bool changed) {
  std::vector<const RunGap*> runs;
  for (const RunGap& run : all)
    if (!run.measured.empty()) runs.push_back(&run);
  const bool many = runs.size() > many_runs;
  const auto place = [&](const RunGap* run) {
    const double left = many ? left_of(*run, changed) : 0.0;
    return std::pair(run->left_out ? 2 : run->held_out ? 0 : 1, std::isfinite(left) ? -left : 0.0);
  };
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const RunGap* a, const RunGap* b) { return place(a) < place(b); });
  return runs;
}

/// The one with this id; null if there is none.
auto by_id(const auto& runs, const std::string& id) {
  const auto at = std::find_if(runs.begin(), runs.end(), [&](const auto& run) { return run.id == id; });
  return at == runs.end() ? nullptr : &*at;
}

/// Whether a page draws this of a model beside the reading that was judged.
bool is_shown(const std::string& key, diagnose::Judged judged) {
  if (judged == diagnose::Judged::angle) return key != "angle";
  const bool pressure = judged == diagnose::Judged::pressure;
  if (pressure && key == "muscle_pressure") return false;
  constexpr std::array<std::string_view, 5> wanted{"valve_pressure", "muscle_pressure", "braid_force",
                                                   "friction_force", "effects_pull"};
  return ((judged == diagnose::Judged::force || pressure) && key == "contraction_ratio") ||
         std::find(wanted.begin(), wanted.end(), key) != wanted.end();
}

/// One model's readings, and what else it did where it was replayed.
/// The force of the cord that was read beside what is judged [N]; null if none was.
const std::vector<double>* force_beside(const domain::Run& run) {
  const domain::Reading* force = run.find("force");
  return force != nullptr && force != &run.judged() ? &force->values : nullptr;
}

Run shown(const char* name, std::size_t style, const RunGap& gap, const std::vector<double>& readings,
          const ReplayedRun* replayed, const domain::Run* recorded, const plant::Rig& rig,
          diagnose::Judged judged) {
  Run run{.name = name, .style = style, .ticks = std::min(readings.size(), gap.measured.size())};
  const auto *model = &readings, *measured = &gap.measured;
  const output::JudgedWords& of = output::words_of(judged);
  run.quantities = {
      {of.signal, [model, size = of.size](std::size_t k) { return (*model)[k] / size; }},
      {"error", [=, size = of.size](std::size_t k) { return ((*measured)[k] - (*model)[k]) / size; }}};
  if (replayed == nullptr || replayed->recording.samples.size() < run.ticks) return run;
  for (auto& quantity : quantities_of(replayed->recording, rig))
    if (is_shown(quantity.key, judged)) run.quantities.push_back(std::move(quantity));
  if (recorded == nullptr || judged == diagnose::Judged::angle) return run;
  if (const auto* force_N = force_beside(*recorded)) {
    const auto pull_N = [replayed](std::size_t k) {
      return std::max(replayed->recording.samples[k].cord_force_N, 0.0);
    };
    run.quantities.push_back({"force", pull_N});
    run.quantities.push_back(
        {"force_error", [force_N, pull_N](std::size_t k) { return (*force_N)[k] - pull_N(k); }});
  }
  if (const domain::Reading* gauge = recorded->find("muscle_pressure"))
    run.quantities.push_back({"muscle_pressure_error", [replayed, gauge](std::size_t k) {
                                const double shown_Pa =
                                    replayed->recording.samples[k].shown[plant::Sensed::muscle_pressure];
                                return (gauge->values[k] - shown_Pa) / plant::Pa_per_bar;
                              }});
  return run;
}

/// What drove a run of one muscle, in the order in which a page lists it.
void add_given(Group& group, const domain::Run& recorded, const plant::Rig& rig) {
  if (!recorded.current_mA.empty()) {
    group.given.push_back(
        {plant::command_key(rig), [&recorded](std::size_t k) { return recorded.current_mA[k]; }});
    if (asks_for_pressure(rig))
      group.given.push_back(
          {"reference_pressure", [&recorded, plant = plant::Plant(rig, recorded.load_kg)](std::size_t k) {
             return plant.reference_pressure_Pa(recorded.current_mA[k]) / 1e5;
           }});
  }
}

Group group_of(const domain::Dataset& data, const Diagnosis& diagnosis, const RunGap& gap,
               const ReplayedRun* nominal, const ReplayedRun* corrected) {
  const diagnose::Judged judged = data.judged();
  const bool hangs = judged == diagnose::Judged::contraction || data.rig.lever() != nullptr,
             pair = data.rig.pair() != nullptr;
  const output::JudgedWords& of = output::words_of(judged);
  const bool changed = output::changed(diagnosis);
  const double load_kg = gap.estimated_load_kg.value_or(gap.load_kg);
  const std::string load = hangs ? ", " + output::mass(load_kg) : "",
                    written = hangs && gap.estimated_load_kg
                                  ? " (" + output::mass(gap.load_kg) + " as written)"
                                  : "";
  Group group{.name = fmt::format("{}{}{}{}", gap.id, load, written,
                                  gap.left_out                                           ? ", left out"
                                  : gap.held_out && !output::each_is_held_out(diagnosis) ? ", held out"
                                                                                         : ""),
              .load_kg = load_kg,
              .ticks = gap.measured.size()};
  group.given = {{std::string("given_") + of.signal,
                  [&gap, size = of.size](std::size_t k) { return gap.measured[k] / size; }}};
  if (hangs) {
    const double weight_N = plant::Plant(diagnosis.corrected, load_kg).weight_N();
    group.given.push_back({"weight", [weight_N](std::size_t) { return weight_N; }});
  }
  const domain::Run* recorded = by_id(data.runs, gap.id);
  if (recorded != nullptr && recorded->rows() < group.ticks) recorded = nullptr;
  if (recorded != nullptr) {
    group.time_s = recorded->time_s;
    if (!pair) add_given(group, *recorded, data.rig);
    for (const domain::Reading& read : recorded->beside())
      group.given.push_back({"given_" + read.channel.key_in_dataset(), [&read](std::size_t k) {
                               return read.values[k] / read.channel.signal->unit.size;
                             }});
  }
  if (const double left = left_of(gap, changed); !pair && std::isfinite(left) && left > 0.0)
    group.rmse = left;
  const auto add = [&](const char* name, std::size_t style, const std::vector<double>& readings,
                       const ReplayedRun* replayed, const plant::Rig& rig) {
    Run run = shown(name, style, gap, readings, replayed, recorded, rig, judged);
    if (run.ticks > 0) group.runs.push_back(std::move(run));
  };
  add("nominal", 1, gap.nominal, nominal, data.rig);
  add("recalibrated", 3, gap.recalibrated, nullptr, data.rig);
  if (changed) add("corrected", 0, gap.corrected, corrected, diagnosis.corrected);
  return group;
}

/// What is judged and its error, then what made it.
std::vector<Plot> plots(const domain::Dataset& data, const Diagnosis& diagnosis) {
  const diagnose::Judged judged = data.judged();
  const bool bench = data.lengths_are_given(), pair = data.rig.pair() != nullptr,
             height = judged == diagnose::Judged::contraction;
  const output::JudgedWords& of = output::words_of(judged);
  const double floor = diagnosis.gap.noise_floor / of.size;
  const std::string error = "Error: measured less model";
  const auto cell = [](const domain::Run& run) { return force_beside(run) != nullptr; };
  auto all =
      plots_of(diagnosis.corrected,
               {.driven = {.pair = pair, .length = bench},
                .key = of.signal,
                .title = fmt::format("{}, measured and by each rig",
                                     judged == diagnose::Judged::pressure ? "Pressure"
                                     : bench                              ? "Force"
                                     : judged == diagnose::Judged::angle  ? "Joint angle"
                                                                          : "Contraction"),
                .given = "Measured",
                .error = !height ? error
                                 : fmt::format("{}, as height of the load{}", error,
                                               floor > 0.0 ? "; logarithmic beyond the noise floor" : ""),
                .commands = !data.pressure_is_given(),
                .pressure = gauged(data),
                .force = !bench && std::ranges::any_of(data.runs, cell),
                .off = "measured less model"});
  for (Plot& plot : all) {
    if (plot.id == "error" && !bench) plot.still = true, plot.floor = floor;
    for (Line& line : plot.lines)  // one for all rigs
      if (!pair && (line.key == plant::command_key(data.rig) || line.key == "reference_pressure"))
        line.given = true;
  }
  return all;
}

std::vector<Loop> loops_of_runs(const domain::Dataset& data) {
  if (data.rig.pair() != nullptr) return loops_of(data.rig, {.pair = true});
  const LoopOver over = loop_over(data.rig, gauged(data));
  const auto against = [&over](const char* what, const char* key, const std::string& label) {
    return Loop{"asked",
                fmt::format("{} and {}", what, over.words),
                over.key,
                key,
                over.label,
                label,
                false,
                over.key,
                std::string("given_") + key};
  };
  if (data.rig.lever() != nullptr)
    return {against("Joint angle", "angle", "joint angle in deg"), loops_of(data.rig, {}).front()};
  if (data.judged() == diagnose::Judged::pressure)
    return {against("Pressure", "muscle_pressure", "pressure in bar")};
  if (data.force_is_judged())
    return {{"force", "Force and pressure", "muscle_pressure", "force", "muscle pressure in bar",
             "force in N", false, "muscle_pressure", "given_force"}};
  return {against("Contraction", "contraction_ratio", std::string(ratio_unit)),
          loops_of(data.rig, {}).front()};
}

std::string floor_in_words(const domain::Dataset& data, const diagnose::Gap& gap) {
  const std::string floor =
      gap.noise_floor > 0.0 ? fmt::format(", here {},", output::amount(gap.noise_floor, gap.judged, data.rig))
                            : "";
  return fmt::format(
      "Differences below the noise floor{} are hidden by the counts and the scatter of the "
      "readings, or occur between equal runs.",
      floor);
}

}  // namespace

std::string report_html(const domain::Dataset& data, const Diagnosis& diagnosis,
                        const std::vector<ReplayedRun>& nominal, const std::vector<ReplayedRun>& corrected) {
  const auto measured_only = diagnosis.runs.empty() ? as_described(data, nominal) : std::vector<RunGap>{};
  const auto runs =
      ordered(diagnosis.runs.empty() ? measured_only : diagnosis.runs, output::changed(diagnosis));
  const bool pair = data.rig.pair() != nullptr;
  Contents contents{
      .title = "Diagnosis of " + output::name_of(data),
      .about = fmt::format("{}, {}", output::runs_in_words(data),
                           output::each_is_held_out(diagnosis)
                               ? output::held_out_in_words(diagnosis)
                               : fmt::format("{} held out", output::held_out(diagnosis).size())),
      .warnings = diagnosis.warnings,
      .sentence = text_html(diagnosis.because.empty() ? output::title_of(diagnosis) + "." : diagnosis.because,
                            data.rig),
      .table = result_table(data, diagnosis),
      .details = output::table_of(data, diagnosis),
      .beside = fmt::format("{}{} Seed {}. Every number is in diagnosis.json, the corrected rig in rig.yaml.",
                            output::words_of(data.judged()).note, floor_in_words(data, diagnosis.gap),
                            diagnosis.seed),
      .chapters = story(data, diagnosis, ordered(diagnosis.runs, output::changed(diagnosis))),
      .later_chapters = doubts_and_plan(data, diagnosis),
      .short_on_paper = true,
      .lengths = !data.rig.has_angle(),
      .rig = diagnosis.corrected,
      .gauge = gauged(data) && !pair,
      .plots = plots(data, diagnosis),
      .loops = loops_of_runs(data),
      .drawn = output::changed(diagnosis) ? 2u : 0u};  // the corrected
  if (!data.rig.has_angle()) contents.rig.mechanics = plant::HangingLoad{};
  const RunGap* telling = telling_run(diagnosis);
  for (const RunGap* run : runs) {
    auto group = group_of(data, diagnosis, *run, by_id(nominal, run->id), by_id(corrected, run->id));
    if (run == telling && !group.runs.empty())
      contents.opening = opening_html(data, diagnosis, group, contents.plots, contents.loops.front());
    if (!group.runs.empty()) contents.groups.push_back(std::move(group));
  }
  return html_of(contents);
}

std::string before_after_svg(const domain::Dataset& data, const Diagnosis& diagnosis,
                             const std::vector<ReplayedRun>& nominal,
                             const std::vector<ReplayedRun>& corrected) {
  const RunGap* telling = telling_run(diagnosis);
  if (telling == nullptr) return "";
  const Group run =
      group_of(data, diagnosis, *telling, by_id(nominal, telling->id), by_id(corrected, telling->id));
  if (run.runs.empty()) return "";
  return opening_svg(data, diagnosis, run, plots(data, diagnosis), loops_of_runs(data).front());
}

}  // namespace mckibben::report
