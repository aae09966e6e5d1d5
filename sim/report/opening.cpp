// Two pictures side by side, or one above the other where the page is narrow; see the header.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/parameter.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/effect_pictures.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/diagnosis_chapters.hpp>
#include <sim/report/opening.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/rig_parts.hpp>
#include <sim/report/sheet.hpp>
#include <sim/report/still.hpp>

namespace mckibben::report {
namespace {

using diagnose::Diagnosis;
using output::escaped;

constexpr double whole_wide = 460.0, whole_high = 330.0, axis_px = 58.0, edge_px = 452.0;
constexpr std::size_t looked_at = 2000;  // ticks of the run: more would not be seen

output::Panel panel(double from_x, double to_x, double top, double bottom) {
  return {.x = {from_x, to_x}, .y = {bottom, top}, .words_px = axis_px - 11.0};
}

std::string picture_of(const std::string& says, const std::string& body) {
  return fmt::format("<svg role='img' viewBox='0 0 {} {}' aria-label='{}'>\n{}</svg>\n", whole_wide,
                     whole_high, escaped(says), body);
}

std::string words_at(double x, double y, const std::string& text, std::string_view kind) {
  return fmt::format("<text x='{:g}' y='{:g}' class='{}'>{}</text>\n", x, y, kind, escaped(text));
}

std::string drawn(const std::vector<Curve>& curves, const output::Panel& panel) {
  std::string svg;
  for (const Curve& curve : curves) svg += curve_svg(curve, panel);
  return svg;
}

/// The run as measured, by the first and by the last of its rigs.
Group before_and_after(Group run) {
  if (run.runs.size() > 2) run.runs.erase(run.runs.begin() + 1, run.runs.end() - 1);
  return run;
}

std::string over_time(const Group& run, const Plot& motion, const Plot& error, double floor,
                      const plant::Rig& rig) {
  output::Panel upper = panel(axis_px, edge_px, 10.0, 150.0), lower = panel(axis_px, edge_px, 172.0, 290.0);
  const auto moves = curves_over_time(run, motion, rig, looked_at),
             errors = curves_over_time(run, error, rig, looked_at);
  hold(moves, upper);
  hold(errors, lower);
  lower.y.hold(-1.5 * floor), lower.y.hold(1.5 * floor);
  for (output::Scale* scale : {&upper.x, &upper.y, &lower.x, &lower.y}) scale->widen(1e-6);
  std::string svg = axes_svg(upper, "", motion.unit, rig) + drawn(moves, upper);
  svg += axes_svg(lower, "time in s", error.unit, rig);
  if (floor > 0.0) {
    const double top = lower.y.px(floor), bottom = lower.y.px(-floor);
    svg += fmt::format("<rect class='band' x='{:g}' y='{:.1f}' width='{:g}' height='{:.1f}'/>\n", axis_px,
                       std::min(top, 0.5 * (top + bottom) - 1.0), edge_px - axis_px,
                       std::max(bottom - top, 2.0));
  }
  return svg + drawn(errors, lower);
}

/// What was found: where it sits, its name, its size.
struct Found {
  Part part;
  std::string name, size;
};

Part part_of_law(const std::string& name, const plant::Effects& effects) {
  using enum plant::LawTarget;
  for (const auto& law : effects.laws.list) {
    if (law.text->name != name) continue;
    if (law.text->adds == command) return Part::command;
    if (law.text->adds == reading) return Part::encoder;
    if (law.text->adds == friction_factor) return Part::threads;
  }
  return Part::muscle;
}

std::vector<Found> found_in(const Diagnosis& diagnosis) {
  std::vector<Found> list;
  for (const auto* effects : {&diagnosis.effects, &diagnosis.stand_ins})
    for (const auto& effect : *effects) {
      list.push_back({part_of(effect.name).value_or(part_of_law(effect.name, diagnosis.corrected.effects)),
                      effect.who().words(),
                      effect.parameters.empty() ? "" : output::readable(effect.parameters.front()).value});
      if (const std::string others = output::or_others(effect); !others.empty())
        list.back().size += (list.back().size.empty() ? "" : "; ") + others;
    }
  for (const auto& fault : diagnosis.bench) {  // of a kind in several runs one mark
    const auto before = std::ranges::find(list, fault.name, &Found::name);
    if (before != list.end())
      before->size = fmt::format(
          "{} runs", std::ranges::count(diagnosis.bench, fault.name, &diagnose::BenchFault::name));
    else
      list.push_back({fault.of_loads() ? Part::guide : Part::encoder, fault.name,
                      output::readable(fault, diagnosis.described).value});
  }
  if (!diagnosis.residual_law.empty())
    list.push_back(
        {Part::muscle, "a law of force", output::readable(diagnosis.residual_law.front().coefficient).value});
  if (!list.empty()) return list;
  auto moved = diagnosis.recalibrated;
  std::erase_if(moved, [](const diagnose::Moved& one) { return !one.notable(); });
  std::ranges::sort(moved, std::greater{}, [](const auto& one) { return std::abs(one.deviations); });
  for (const auto& one : moved)
    list.push_back({part_of(one.fitted.name).value_or(Part::muscle), one.fitted.name,
                    output::readable(one.fitted).value});
  return list;
}

/// The corrected rig with what was added so many times as large.
plant::Rig enlarged(const plant::Rig& nominal, const Diagnosis& diagnosis, double times) {
  plant::Rig rig = diagnosis.corrected;
  for (const auto* effects : {&diagnosis.effects, &diagnosis.stand_ins})
    for (const auto& effect : *effects)
      for (const auto& law : diagnose::catalogue(nominal))
        if (law.effect == effect.name && law.variant == effect.variant)
          law.put(rig, law.absent + times * (diagnose::value_of(rig, law.amplitude) - law.absent));
  return rig;
}

/// The largest difference of two loops, as a share of the range of the first.
double apart(const std::vector<std::pair<double, double>>& one,
             const std::vector<std::pair<double, double>>& other) {
  double low = 1e300, high = -1e300, most = 0.0;
  for (std::size_t k = 0; k < std::min(one.size(), other.size()); ++k) {
    low = std::min(low, one[k].second), high = std::max(high, one[k].second);
    most = std::max(most, std::abs(one[k].second - other[k].second));
  }
  return most / (high - low);
}

/// The loop of a slow ride up and down under this run's load, without and with what was found, enlarged until
/// it is plain to see; empty where no current drives one muscle.
std::string what_it_does(const domain::Dataset& data, const Diagnosis& diagnosis, const Group& run,
                         output::Panel panel) {
  constexpr double plain = 0.12, period_s = 20.0;
  const auto current = std::ranges::find(run.given, plant::command_key(data.rig), &Quantity::key);
  if (current == run.given.end() || data.judged() != diagnose::Judged::contraction ||
      !asks_for_pressure(data.rig))
    return "";
  controllers::TriangleCurrent up_and_down{.low_mA = data.rig.valve.zero_command, .period_s = period_s};
  up_and_down.high_mA = up_and_down.low_mA;
  for (std::size_t k = 0; k < run.ticks; ++k)
    up_and_down.high_mA = std::max(up_and_down.high_mA, current->at(k));
  const auto ride = [&](const plant::Rig& rig) {
    return output::loop_of(rig, run.load_kg, up_and_down, 2.0 * period_s);
  };
  const bool by_name = !diagnosis.effects.empty() || !diagnosis.stand_ins.empty();
  plant::Rig without = data.rig;
  if (by_name || !diagnosis.residual_law.empty())
    without = diagnosis.corrected, without.effects = data.rig.effects;
  std::vector<Curve> loops;
  double shown = 1.0;
  try {
    loops = {{.kind = "class='without'", .points = ride(without)},
             {.kind = "class='run c0'", .points = ride(diagnosis.corrected)}};
    for (const double times : {3.0, 10.0, 30.0})
      if (by_name && apart(loops.front().points, loops.back().points) < plain) {
        loops.back().points = ride(enlarged(data.rig, diagnosis, times));
        shown = times;
      }
  } catch (const std::runtime_error&) {  // such a ride would leave the range of the laws
    if (loops.empty()) return "";
  }
  hold(loops, panel);
  for (output::Scale* scale : {&panel.x, &panel.y}) scale->widen(1e-6);
  return axes_svg(panel, "", "", data.rig) + panel.frame() + drawn(loops, panel) +
         (shown > 1.0 ? words_at(panel.x.from_px + 4.0, panel.y.from_px + 15.0,
                                 fmt::format("{:g} \u00d7 as large", shown), "soft")
                      : "");
}

std::string loop_and_rig(const domain::Dataset& data, const Diagnosis& diagnosis, const Group& run,
                         const Loop& loop) {
  constexpr std::size_t most_told = 3;
  constexpr double column = 268.0;
  output::Panel seen = panel(axis_px, 250.0, 10.0, 290.0);
  const auto loops = curves_of(run, loop, looked_at);
  hold(loops, seen);
  for (output::Scale* scale : {&seen.x, &seen.y}) scale->widen(1e-6);
  std::string svg =
      loops.empty() ? "" : axes_svg(seen, loop.x_label, loop.y_label, data.rig) + drawn(loops, seen);
  auto found = found_in(diagnosis);
  const std::size_t more = found.size() - std::min(found.size(), most_told);
  found.resize(found.size() - more, {});
  double y = 22.0;
  if (data.rig.pair() == nullptr) {  // the drawing is of one muscle
    std::vector<Part> marks;
    marks.reserve(found.size());
    for (const Found& one : found) marks.push_back(one.part);
    svg +=
        fmt::format("<g transform='translate({:g} 0)'>\n{}</g>\n", column, rig_drawing(marks, gauged(data)));
    y = 172.0;
  }
  for (std::size_t i = 0; i < found.size(); ++i, y += 32.0)
    svg += words_at(column, y, fmt::format("{} {}", i + 1, found[i].name), "strong") +
           words_at(column + 12.0, y + 15.0, found[i].size, "soft");
  if (more > 0) svg += words_at(column, y, fmt::format("and {} more", more), "soft"), y += 16.0;
  if (!found.empty() && output::rig_changed(diagnosis))
    svg += what_it_does(data, diagnosis, run, panel(column, edge_px, y - 4.0, whole_high - 40.0));
  return svg;
}

/// The two pictures.
std::vector<Picture> pictures_of(const domain::Dataset& data, const Diagnosis& diagnosis, const Group& run,
                                 const std::vector<Plot>& plots, const Loop& loop) {
  const Plot& error = *std::ranges::find(plots, "error", &Plot::id);
  const double floor = diagnosis.gap.noise_floor / output::words_of(data.judged()).size;
  return {
      {"", picture_of("Measured, before and after, over time",
                      over_time(run, plots.front(), error, floor, data.rig))},
      {"", picture_of("The same as a loop, and what was added", loop_and_rig(data, diagnosis, run, loop))}};
}

std::string caption_of(const Diagnosis& diagnosis, const Group& run) {
  return fmt::format("{}. Below: measured less model, and the noise floor as a band.{}", run.name,
                     found_in(diagnosis).empty()       ? ""
                     : !output::rig_changed(diagnosis) ? " Right: where the bench is at fault."
                     : asks_for_pressure(diagnosis.corrected)
                         ? " Right: where the effect acts, and a slow loop without it (wide) and with it."
                         : " Right: where the effect acts.");
}

}  // namespace

const diagnose::RunGap* telling_run(const Diagnosis& diagnosis) {
  const bool changed = output::changed(diagnosis);
  const bool unseen = std::ranges::any_of(diagnosis.runs, &diagnose::RunGap::held_out);
  const diagnose::RunGap* best = nullptr;
  double most = 0.0;
  for (const auto& run : diagnosis.runs) {
    if (run.left_out || run.held_out != unseen || run.measured.empty()) continue;
    const double shrank = std::pow(run.nominal_rmse, 2) - std::pow(left_of(run, changed), 2);
    if (best == nullptr || shrank > most) best = &run, most = shrank;
  }
  return best;
}

std::string opening_html(const domain::Dataset& data, const Diagnosis& diagnosis, const Group& whole,
                         const std::vector<Plot>& plots, const Loop& loop) {
  const Group run = before_and_after(whole);
  std::string html = "<figure class='opening'>\n<p class='keys'>";
  for (const auto& [kind, words] : keys_of(run))
    html += fmt::format(
        "<span><svg viewBox='0 0 34 10' aria-hidden='true'><path class='{}' d='M0 5H34'/></svg>{}</span>",
        kind, words);
  html += "</p>\n<div>\n";
  for (const Picture& one : pictures_of(data, diagnosis, run, plots, loop)) html += one.svg;
  return html +
         fmt::format("</div>\n<figcaption>{}</figcaption>\n</figure>\n", escaped(caption_of(diagnosis, run)));
}

std::string opening_svg(const domain::Dataset& data, const Diagnosis& diagnosis, const Group& whole,
                        const std::vector<Plot>& plots, const Loop& loop) {
  const Group run = before_and_after(whole);
  return sheet_svg(pictures_of(data, diagnosis, run, plots, loop), whole_wide, whole_high, keys_of(run),
                   caption_of(diagnosis, run));
}

}  // namespace mckibben::report
