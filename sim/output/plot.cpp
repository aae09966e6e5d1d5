// Panels, axes and lines of the tracking picture.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/output/plot.hpp>
#include <sim/output/svg.hpp>

namespace mckibben::output {
namespace {

constexpr double plot_width = 900.0, plot_height = 190.0, plot_left = 60.0, plot_right = 20.0,
                 plot_gap = 46.0;

struct PlotPanel {
  double y0_px;      // upper edge
  double low, high;  // contraction ratios at lower and upper edge
  double duration_s;

  double x_px(double time_s) const { return plot_left + plot_width * time_s / duration_s; }
  double y_px(double ratio) const { return y0_px + plot_height * (high - ratio) / (high - low); }

  std::string axes(const std::string& title) const {
    std::string svg = fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#888'/>\n",
                                  plot_left, y0_px, plot_width, plot_height);
    svg += fmt::format("<text x='{}' y='{}' font-weight='bold'>{}</text>\n", plot_left, y0_px - 8, title);
    const double step = tick_step(high - low, 6);
    for (double r = std::ceil(low / step) * step; r <= high; r += step)
      svg += fmt::format(
          "<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' stroke='#ddd'/><text x='{3}' y='{4:.1f}' "
          "text-anchor='end'>{5:.3g}</text>\n",
          plot_left, plot_left + plot_width, y_px(r), plot_left - 6, y_px(r) + 4,
          std::abs(r) < 1e-9 ? 0.0 : r);
    const double step_s = tick_step(duration_s, 10);
    for (double t = 0.0; t <= duration_s * (1 + 1e-9); t += step_s)
      svg += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>{:g} s</text>\n", x_px(t),
                         y0_px + plot_height + 16, t);
    return svg;
  }

  /// A line through one value each tick; at most a point for each pixel, the extreme ones of each.
  template <class Value>
  std::string line(std::size_t ticks, double tick_s, const char* colour, const char* dash, double width,
                   const Value& value) const {
    const auto per_pixel = std::max<std::size_t>(1, ticks / static_cast<std::size_t>(plot_width));
    std::string points;
    for (std::size_t k = 0; k < ticks; k += per_pixel) {
      const auto put = [&](std::size_t i) {
        points += fmt::format("{:.1f},{:.1f} ", x_px(static_cast<double>(i) * tick_s), y_px(value(i)));
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
        dash, width, points);
  }
};

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
  double x = plot_left;
  const auto add = [&](const std::string& name, const char* colour, const char* dash) {
    const double needed = 40.0 + 7.5 * static_cast<double>(name.size());
    if (x > plot_left && x + needed > plot_left + plot_width) {
      x = plot_left;
      legend.bottom_px += 18.0;
    }
    legend.svg += fmt::format(
        "<line x1='{0}' x2='{1}' y1='{2}' y2='{2}' stroke='{3}' stroke-dasharray='{4}' stroke-width='2.5'/>"
        "<text x='{5}' y='{6}'>{7}</text>\n",
        x, x + 22, legend.bottom_px, colour, dash, x + 27, legend.bottom_px + 4, name);
    x += needed;
  };
  add("target", "#000000", "none");
  for (std::size_t c = 0; c < scenario.controllers.size(); ++c)
    add(controllers::name_of(scenario.controllers[c]), colour_of(c), dash_of(c));
  return legend;
}

}  // namespace

std::string tracking_svg(const domain::Scenario& scenario, const run::Comparison& comparison) {
  const std::size_t columns = scenario.controllers.size(), rows = scenario.loads_kg.size();
  const Legend legend = make_legend(scenario);
  const double first_px = legend.bottom_px + 30.0;
  const double height = first_px + static_cast<double>(rows) * (plot_height + plot_gap) + 10.0;
  const double width = plot_left + plot_width + plot_right;
  double low = *std::min_element(comparison.target.begin(), comparison.target.end());
  double high = *std::max_element(comparison.target.begin(), comparison.target.end());
  for (const auto& run : comparison.runs)
    for (const auto& sample : run.recording.samples) {
      low = std::min(low, sample.state.joint.contraction_ratio);
      high = std::max(high, sample.state.joint.contraction_ratio);
    }
  const double margin = std::max(0.05 * (high - low), 1e-4);
  const double tick_s = scenario.rig.tick_s;

  std::string svg = svg_begin(width, height) + legend.svg;
  for (std::size_t r = 0; r < rows; ++r) {
    const PlotPanel panel{first_px + static_cast<double>(r) * (plot_height + plot_gap), low - margin,
                          high + margin, static_cast<double>(comparison.target.size()) * tick_s};
    svg += panel.axes(fmt::format("{} kg: contraction ratio", domain::write_number(scenario.loads_kg[r])));
    svg += panel.line(comparison.target.size(), tick_s, "#000000", "none", 2.2,
                      [&](std::size_t k) { return comparison.target[k]; });
    for (std::size_t c = 0; c < columns; ++c) {
      const auto& samples = comparison.runs[r * columns + c].recording.samples;
      svg += panel.line(samples.size(), tick_s, colour_of(c), dash_of(c), 1.4,
                        [&](std::size_t k) { return samples[k].state.joint.contraction_ratio; });
    }
  }
  return svg + "</svg>\n";
}

}  // namespace mckibben::output
