// Panels and lines of the pictures of runs: what is followed over time, and loops.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>

#include <plant/signals.hpp>
#include <sim/domain/number.hpp>
#include <sim/output/axes.hpp>
#include <sim/output/run_results.hpp>
#include <sim/output/svg.hpp>
#include <sim/run/remarks.hpp>

namespace mckibben::output {
namespace {

constexpr double plot_width = 900.0, plot_height = 190.0, plot_left = 60.0, plot_right = 20.0,
                 plot_gap = 46.0;

/// What is followed over time, below an upper edge.
Panel panel_at(double top_px, double low, double high, double duration_s) {
  return {.x = {.from_px = plot_left, .to_px = plot_left + plot_width, .low = 0.0, .high = duration_s},
          .y = {.from_px = top_px + plot_height, .to_px = top_px, .low = low, .high = high}};
}

std::string axes(const Panel& panel, const std::string& title) {
  std::vector<Tick> times = round_numbers(panel.x, 10);
  for (Tick& tick : times) tick.text += " s";
  return panel.heading(title) + panel.across(times, "") + panel.upwards(round_numbers(panel.y, 6), "") +
         panel.frame();
}

std::string polyline(const char* colour, const char* dash, double stroke_width, const std::string& points) {
  return fmt::format(
      "<polyline fill='none' stroke='{}' stroke-dasharray='{}' stroke-width='{}' points='{}'/>\n", colour,
      dash, stroke_width, points);
}

/// A line through one value each tick; at most a point for each pixel, the extreme ones of each.
std::string line(const Panel& panel, std::size_t ticks, double tick_s, const char* colour, const char* dash,
                 double stroke_width, const auto& value) {
  const auto per_pixel = std::max<std::size_t>(1, ticks / static_cast<std::size_t>(plot_width));
  std::string points;
  for (std::size_t k = 0; k < ticks; k += per_pixel) {
    const auto put = [&](std::size_t i) {
      points +=
          fmt::format("{:.1f},{:.1f} ", panel.x.px(static_cast<double>(i) * tick_s), panel.y.px(value(i)));
    };
    std::size_t least = k, most = k;
    for (std::size_t i = k; i < std::min(k + per_pixel, ticks); ++i) {
      if (value(i) < value(least)) least = i;
      if (value(i) > value(most)) most = i;
    }
    put(std::min(least, most));
    if (least != most) put(std::max(least, most));
  }
  return polyline(colour, dash, stroke_width, points);
}

/// Colours first, then the same ones dashed.
const char* colour_of(std::size_t controller) {
  return colours[controller % colours.size()];
}
const char* dash_of(std::size_t controller) {
  constexpr std::array<const char*, 3> dashes{"none", "7 3", "2 3"};
  return dashes[controller / colours.size() % dashes.size()];
}

struct Legend {
  std::string svg;
  double bottom_px = 14.0;
};

/// Names beside their lines, in as many rows as they need.
Legend make_legend(const domain::Scenario& scenario, bool with_target) {
  Legend legend;
  Rows rows(plot_left, plot_left + plot_width, legend.bottom_px);
  const auto add = [&](const std::string& name, const char* colour, const char* dash) {
    const auto [x, y] = rows.next(40.0 + width_px(name, 12.5));
    legend.svg += fmt::format(
        "<line x1='{0}' x2='{1}' y1='{2}' y2='{2}' stroke='{3}' stroke-dasharray='{4}' stroke-width='2.5'/>"
        "<text x='{5}' y='{6}'>{7}</text>\n",
        x, x + 22, y, colour, dash, x + 27, y + 4, name);
    legend.bottom_px = y;
  };
  if (with_target) add("target", "#000000", "none");
  for (std::size_t c = 0; c < scenario.controllers.size(); ++c)
    add(controllers::name_of(scenario.controllers[c]), colour_of(c), dash_of(c));
  return legend;
}

/// Target and load that a row of runs has in common.
std::string title_of(const run::Comparison& comparison, const run::Task& task) {
  const std::string& target = comparison.targets[task.target].name;
  return fmt::format("{}{}{} kg", target, target.empty() ? "" : ", ", domain::write_kg(task.load_kg));
}

}  // namespace

std::string tracking_svg(const domain::Scenario& scenario, const run::Comparison& comparison) {
  const auto tasks = run::tasks_of(scenario);
  const plant::Driven driven{.pair = scenario.rig.pair() != nullptr};
  const auto channels = plant::channels_of(scenario.rig, driven);
  const plant::Channel& followed =
      plant::channel_of(channels, scenario.rig.has_angle() ? "angle" : "contraction_ratio");
  const double page_size = followed.signal->unit.page_size, tick_s = scenario.rig.tick_s;
  const bool with_target = !run::follows_nothing(scenario, comparison);
  const Legend legend = make_legend(scenario, with_target);
  const double first_px = legend.bottom_px + 30.0;
  const double height = first_px + static_cast<double>(tasks.size()) * (plot_height + plot_gap) + 10.0;
  const double width = plot_left + plot_width + plot_right;
  Scale values{0.0, 0.0};
  for (const run::Wanted& target : comparison.targets)
    for (const double value : target.values) values.hold(value / page_size);
  for (const auto& run : comparison.runs)
    if (run.followed())
      for (const auto& sample : run.recording.samples) values.hold(followed.on_page(sample));
  values.widen(1e-4);

  std::string svg = svg_begin(width, height) + legend.svg;
  for (std::size_t r = 0; r < tasks.size(); ++r) {
    const run::Wanted& target = comparison.targets[tasks[r].target];
    const std::size_t ticks = target.values.size();
    const Panel panel = panel_at(first_px + static_cast<double>(r) * (plot_height + plot_gap), values.low,
                                 values.high, static_cast<double>(ticks) * tick_s);
    svg += axes(panel, title_of(comparison, tasks[r]) +
                           (scenario.rig.has_angle() ? ": joint angle [deg]" : ": contraction ratio"));
    if (with_target)
      svg += line(panel, ticks, tick_s, "#000000", "none", 2.2,
                  [&](std::size_t k) { return target.values[k] / page_size; });
    for (std::size_t c = 0; c < scenario.controllers.size(); ++c) {
      const auto& samples = comparison.runs[tasks[r].first + c].recording.samples;
      svg += line(panel, samples.size(), tick_s, colour_of(c), dash_of(c), 1.4,
                  [&](std::size_t k) { return followed.on_page(samples[k]); });
    }
  }
  return svg + "</svg>\n";
}

std::string loops_svg(const domain::Scenario& scenario, const run::Comparison& comparison) {
  constexpr double across_px = 400.0, up_px = 280.0, gap_px = 70.0, nearest_px = 0.7;
  const bool pair = scenario.rig.pair() != nullptr;
  const auto channels = plant::channels_of(scenario.rig, {.pair = pair});
  struct Loops {
    std::string title;
    plant::Channel x, y;
    std::vector<std::span<const run::Sample>> runs;
  };
  std::vector<Loops> panels;
  Scale x{0.0, 0.0}, y{0.0, 0.0};
  const auto add = [&](const std::string& title, std::size_t first, std::size_t count) {
    for (const std::string muscle : pair ? std::vector{"_1", "_2"} : std::vector{""}) {
      Loops& one = panels.emplace_back(title + (pair ? ", muscle " + muscle.substr(1) : ""),
                                       channel_of(channels, "contraction_ratio" + muscle),
                                       channel_of(channels, "muscle_pressure" + muscle));
      for (std::size_t i = first; i < first + count; ++i)
        for (const run::Sample& row : one.runs.emplace_back(comparison.runs[i].recording.samples))
          x.hold(one.x.on_page(row)), y.hold(one.y.on_page(row));
    }
  };
  for (const run::Task& task : run::tasks_of(scenario))
    add(title_of(comparison, task), task.first, scenario.controllers.size());
  for (std::size_t i = 0; i < comparison.runs.size(); ++i)
    if (!comparison.runs[i].followed()) add(comparison.runs[i].name, i, 1);
  x.widen(1e-4), y.widen(1e-2);

  const Legend legend = make_legend(scenario, false);
  const double rows = std::ceil(0.5 * static_cast<double>(panels.size()));
  std::string svg =
      svg_begin(plot_left + 2.0 * (across_px + gap_px), legend.bottom_px + 40.0 + rows * (up_px + gap_px)) +
      legend.svg;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Loops& loops = panels[i];
    const double left = plot_left + static_cast<double>(i % 2) * (across_px + gap_px),
                 top = legend.bottom_px + 40.0 + static_cast<double>(i / 2) * (up_px + gap_px);
    Panel panel{.x = x, .y = y};
    panel.x.from_px = left, panel.x.to_px = left + across_px;
    panel.y.from_px = top + up_px, panel.y.to_px = top;
    svg += panel.heading(loops.title) + panel.across(round_numbers(panel.x, 6), "contraction ratio") +
           panel.upwards(round_numbers(panel.y, 6), "muscle pressure [bar]") + panel.frame();
    for (std::size_t c = 0; c < loops.runs.size(); ++c) {
      std::string points;
      double last_x = -1.0, last_y = -1.0;
      for (const run::Sample& row : loops.runs[c]) {
        const double to_x = panel.x.px(loops.x.on_page(row)), to_y = panel.y.px(loops.y.on_page(row));
        if (std::hypot(to_x - last_x, to_y - last_y) < nearest_px) continue;
        points += fmt::format("{:.1f},{:.1f} ", last_x = to_x, last_y = to_y);
      }
      svg += polyline(colour_of(c), dash_of(c), 1.4, points);
    }
  }
  return svg + "</svg>\n";
}

}  // namespace mckibben::output
