// Panels and lines of the tracking picture.
#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include <plant/signals.hpp>
#include <sim/domain/number.hpp>
#include <sim/output/axes.hpp>
#include <sim/output/run_results.hpp>
#include <sim/output/svg.hpp>

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

/// A line through one value each tick; at most a point for each pixel, the extreme ones of each.
template <class Value>
std::string line(const Panel& panel, std::size_t ticks, double tick_s, const char* colour, const char* dash,
                 double stroke_width, const Value& value) {
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
  return fmt::format(
      "<polyline fill='none' stroke='{}' stroke-dasharray='{}' stroke-width='{}' points='{}'/>\n", colour,
      dash, stroke_width, points);
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
Legend make_legend(const domain::Scenario& scenario) {
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
  add("target", "#000000", "none");
  for (std::size_t c = 0; c < scenario.controllers.size(); ++c)
    add(controllers::name_of(scenario.controllers[c]), colour_of(c), dash_of(c));
  return legend;
}

}  // namespace

std::string tracking_svg(const domain::Scenario& scenario, const run::Comparison& comparison) {
  const auto tasks = run::tasks_of(scenario);
  const plant::Driven driven{.pair = scenario.rig.pair() != nullptr};
  const auto channels = plant::channels_of(scenario.rig, driven);
  const plant::Channel& followed =
      plant::channel_of(channels, scenario.rig.has_angle() ? "angle" : "contraction_ratio");
  const double page_size = followed.signal->unit.page_size, tick_s = scenario.rig.tick_s;
  const Legend legend = make_legend(scenario);
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
    svg += axes(panel, fmt::format("{}{}{} kg: {}", target.name, target.name.empty() ? "" : ", ",
                                   domain::write_number(tasks[r].load_kg),
                                   scenario.rig.has_angle() ? "joint angle [deg]" : "contraction ratio"));
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

}  // namespace mckibben::output
