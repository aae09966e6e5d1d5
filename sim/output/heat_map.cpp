// Blue for too low, orange for too high, white for right: told apart by the colour-blind (Okabe & Ito's blue
// and vermillion). A colour scale holds nine tenths of the errors within reach: what lies beyond is often so
// far off that nothing else would be seen.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <sim/output/axes.hpp>
#include <sim/output/error_map.hpp>
#include <sim/output/svg.hpp>

namespace mckibben::output {
namespace {

using controllers::Branch;

constexpr double map_width = 390.0, map_height = 210.0, map_left = 62.0, title_px = 15.0;
constexpr double between_x = 56.0, between_y = 66.0, scale_width = 14.0, map_right = 92.0;

std::string colour(double share) {  // from -1 to 1
  constexpr double low[] = {0, 114, 178}, high[] = {213, 94, 0};
  const double depth = std::min(std::abs(share), 1.0);
  const auto mixed = [&](int i) {
    return static_cast<int>(std::lround(std::lerp(255.0, (share < 0.0 ? low : high)[i], depth)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(0), mixed(1), mixed(2));
}

/// What is written beside ratios and speeds, and how many of the unit a ratio of 1 is.
struct Words {
  double factor;
  const char *ratio, *speed, *ratio_error, *speed_error;
};
Words words_of(MapUnit unit, const plant::Rig& rig) {
  if (unit == MapUnit::ratio)
    return {1.0, "target contraction ratio", "target speed [1/s]", "error of contraction ratio",
            "error of speed [1/s]"};
  return {1e3 * rig.muscle.rest_length_m, "target contraction [mm]", "target speed [mm/s]",
          "error of height [mm]", "error of speed [mm/s]"};
}

/// One kind of error, and where its colours end, in ratios.
struct Measure {
  double (run::MapCell::*error)() const;
  const char* title;
  double limit;
};

/// A round number of the unit of which a ratio of 1 is `factor`.
double limit_of(const run::LoadMap& load, double (run::MapCell::*error)() const, double factor) {
  std::vector<double> within, all;
  for (const auto& map : load.branches)
    for (const auto& cell : map.cells) {
      if (!cell.arrival) continue;
      all.push_back(std::abs((cell.*error)()));
      if (cell.reachable) within.push_back(all.back());
    }
  std::vector<double>& sizes = within.empty() ? all : within;
  std::sort(sizes.begin(), sizes.end());
  const double most = sizes.empty() ? 0.0 : sizes[9 * (sizes.size() - 1) / 10];
  return most > 0.0 ? tick_step(factor * most, 1) / factor : 1.0;
}

/// Edges of the cells around ascending values: halfway between two, as far outside.
std::vector<double> edges(const std::vector<double>& values) {
  const std::size_t n = values.size();
  if (n == 1) return {0.5 * values[0], 1.5 * values[0]};
  std::vector<double> at{values[0] - 0.5 * (values[1] - values[0])};
  for (std::size_t i = 1; i < n; ++i) at.push_back(0.5 * (values[i - 1] + values[i]));
  at.push_back(values[n - 1] + 0.5 * (values[n - 1] - values[n - 2]));
  return at;
}

class MapPanel {
 public:
  MapPanel(const run::MapPlan& plan, const Words& words, double x_px, double y_px)
      : plan_(plan),
        words_(words),
        ratios_(edges(plan.ratios)),
        speeds_(edges(plan.speeds_per_s)),
        panel_{
            .x = {.from_px = x_px, .to_px = x_px + map_width, .low = ratios_.front(), .high = ratios_.back()},
            .y = {.from_px = y_px + map_height,
                  .to_px = y_px,
                  .low = speeds_.front(),
                  .high = speeds_.back()},
            .words_px = 50.0,
            .with_grid = false} {}

  std::string cells(const run::BranchMap& map, const Measure& measure) const {
    std::string svg, marks;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const auto& cell = map.cells[i];
      const std::size_t column = i % plan_.ratios.size(), row = i / plan_.ratios.size();
      const double left_px = x(ratios_[column]), right_px = x(ratios_[column + 1]);
      const double top_px = y(speeds_[row + 1]), bottom_px = y(speeds_[row]);
      const std::string fill =
          cell.arrival ? colour((cell.*measure.error)() / measure.limit) : std::string("#999");
      svg += fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='{}'/>\n", left_px,
                         top_px, right_px - left_px, bottom_px - top_px, fill);
      const double x_px = 0.5 * (left_px + right_px), y_px = 0.5 * (top_px + bottom_px);
      if (cell.asked.unreachable)
        marks += fmt::format("M{:.1f} {:.1f}l6 6m0 -6l-6 6", x_px - 3.0, y_px - 3.0);
      else if (!cell.as_asked())
        marks += fmt::format("M{:.1f} {:.1f}h2", x_px - 1.0, y_px);
    }
    return svg + fmt::format("<path d='{}' stroke='#333' stroke-width='1.4' fill='none'/>\n", marks);
  }

  /// The largest speed over the way of the load, cut off at the panel's upper edge.
  std::string border(const run::ErrorMaps& maps, const controllers::ReachOfLoad& limits,
                     Branch branch) const {
    const bool up = branch == Branch::contraction;
    const double from = std::max(up ? limits.lowest_rising : limits.lowest_falling, ratios_.front());
    const double to = std::min(limits.highest, ratios_.back());
    if (from >= to) return "";
    std::string path = fmt::format("M{:.1f} {:.1f}", x(from), y(speeds_.front()));
    constexpr int parts = 200;
    for (int i = 0; i <= parts; ++i) {
      const double ratio = std::lerp(from, to, static_cast<double>(i) / parts);
      const double speed = maps.reach.at_ratio(up ? limits.rising_per_s : limits.falling_per_s, ratio);
      path += fmt::format("L{:.1f} {:.1f}", x(ratio), y(std::clamp(speed, speeds_.front(), speeds_.back())));
    }
    path += fmt::format("L{:.1f} {:.1f}", x(to), y(speeds_.front()));
    const auto line = [&](const char* stroke, double stroke_width) {
      return fmt::format("<path class='border' d='{}' fill='none' stroke='{}' stroke-width='{}'/>\n", path,
                         stroke, stroke_width);
    };
    return line("white", 5.0) + line("black", 2.2);
  }

  std::string axes(const std::string& title) const {
    std::vector<Tick> speeds;  // few are named each, many by every n-th
    const std::size_t every = 1 + (plan_.speeds_per_s.size() - 1) / 10;
    for (std::size_t i = 0; i < plan_.speeds_per_s.size(); i += every)
      speeds.push_back(
          {y(plan_.speeds_per_s[i]), fmt::format("{:.3g}", words_.factor * plan_.speeds_per_s[i])});
    return panel_.frame() + panel_.heading(title) +
           panel_.across(round_numbers(panel_.x, 7, words_.factor), words_.ratio) +
           panel_.upwards(speeds, words_.speed);
  }

 private:
  double x(double ratio) const { return panel_.x.px(ratio); }
  double y(double speed) const { return panel_.y.px(speed); }

  const run::MapPlan& plan_;
  const Words& words_;
  std::vector<double> ratios_, speeds_;
  Panel panel_;
};

std::string scale_svg(const Measure& measure, double factor, double x_px, double y_px) {
  std::string svg;
  constexpr int steps = 40;
  for (int i = 0; i < steps; ++i)
    svg += fmt::format("<rect x='{}' y='{:.2f}' width='{}' height='{:.2f}' fill='{}'/>\n", x_px,
                       y_px + map_height * i / steps, scale_width, map_height / steps + 0.3,
                       colour(1.0 - 2.0 * (i + 0.5) / steps));
  for (const double share : {-1.0, -0.5, 0.0, 0.5, 1.0})
    svg += fmt::format("<text x='{}' y='{:.1f}'>{}{}</text>\n", x_px + scale_width + 5.0,
                       y_px + 4.0 + map_height * (0.5 - 0.5 * share),
                       share == 1.0    ? "≥ "
                       : share == -1.0 ? "≤ "
                                       : "",
                       share == 0.0 ? "0" : fmt::format("{:+.3g}", share * measure.limit * factor));
  return svg + fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#888'/>\n", x_px,
                           y_px, scale_width, map_height);
}

}  // namespace

std::string heat_map_svg(const run::MapPlan& plan, const run::ErrorMaps& maps, const run::LoadMap& load,
                         MapUnit unit) {
  const Words words = words_of(unit, plan.rig);
  const Measure measures[] = {{&run::MapCell::ratio_error, words.ratio_error,
                               limit_of(load, &run::MapCell::ratio_error, words.factor)},
                              {&run::MapCell::speed_error_per_s, words.speed_error,
                               limit_of(load, &run::MapCell::speed_error_per_s, words.factor)}};
  const auto columns = static_cast<double>(load.branches.size());
  const double width = map_left + columns * map_width + (columns - 1.0) * between_x + map_right;
  const double widest_px = width - map_left - 6.0;
  const auto title = wrapped(
      fmt::format("{:g} kg (weighed as {:.2f} kg, {:+.1f} %{}): error at arrival, reached less target",
                  load.load_kg, load.weighed_kg, 100.0 * load.weighing_error(),
                  load.extrapolated ? "; extrapolated" : ""),
      widest_px, title_px, true);
  std::vector<std::string> legend;
  for (const char* text : {"line: border of what the rig can reach; positive errors: too high, too fast",
                           "x: the inverse finds no current speed; dot: beyond its calibrated range or the "
                           "valve's line; grey: no run"})
    for (std::string& line : wrapped(text, widest_px, 12.0)) legend.push_back(std::move(line));
  double y_px = 54.0 + 20.0 * static_cast<double>(title.size());
  const double legend_px = y_px + 2.0 * map_height + between_y + 70.0;
  const double height = legend_px + 18.0 * static_cast<double>(legend.size());
  std::string svg = svg_begin(width, height) +
                    lines_svg(title, map_left, 26.0, 20.0, " font-size='15' font-weight='bold'") +
                    lines_svg(legend, map_left, legend_px, 18.0);
  for (const Measure& measure : measures) {
    double x_px = map_left;
    for (const auto& map : load.branches) {
      const MapPanel panel(plan, words, x_px, y_px);
      const char* way = map.branch == Branch::contraction ? "up" : "down";
      svg += panel.cells(map, measure) + panel.border(maps, load.limits, map.branch) +
             panel.axes(fmt::format("{}: {}", way, measure.title));
      x_px += map_width + between_x;
    }
    svg += scale_svg(measure, words.factor, x_px - between_x + 16.0, y_px);
    y_px += map_height + between_y;
  }
  return svg + "</svg>\n";
}

}  // namespace mckibben::output
