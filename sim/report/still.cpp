// Panels and lines; see the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/output/svg.hpp>
#include <sim/report/length.hpp>
#include <sim/report/still.hpp>

namespace mckibben::report {
namespace {

using output::escaped;

constexpr double left = 66.0, right = 10.0, top = 10.0, bottom = 42.0;

std::string attribute(char name, const output::Scale& scale) {
  return fmt::format(" data-{}='{} {} {} {}'", name, scale.low, scale.high, scale.from_px, scale.to_px);
}

/// An axis drawn in a unit; in mm and as ratios where that is what it shows.
std::string in_units(const std::string& label, const plant::Rig& rig, const auto& drawn) {
  if (label != ratio_unit) return drawn(1.0, label);
  return either(drawn(length_mm(rig), "contraction in mm"), drawn(1.0, label), "g");
}

std::string floor_svg(const output::Panel& panel) {
  const output::Scale &x = panel.x, &y = panel.y;
  return fmt::format(
      "<path class='floor' d='M{0} {1:.1f}H{2}M{0} {3:.1f}H{2}'/><text x='{4}' y='{5:.1f}' "
      "class='halo' text-anchor='end'>noise floor</text>\n",
      x.from_px, y.px(y.floor), x.to_px, y.px(-y.floor), x.to_px - 3.0, y.px(y.floor) - 4.0);
}

/// Every how many of `ticks` are looked at.
std::size_t stride(std::size_t ticks, std::size_t most) {
  return std::max<std::size_t>(1, (ticks + most - 1) / most);
}

const AtTick* find(const std::vector<Quantity>& quantities, const std::string& key) {
  for (const auto& quantity : quantities)
    if (quantity.key == key) return &quantity.at;
  return nullptr;
}

/// Of a run, or else of what was given to all.
const AtTick* find(const Group& group, const Run& run, const std::string& key) {
  const AtTick* own = find(run.quantities, key);
  return own != nullptr ? own : find(group.given, key);
}

std::string run_class(const Run& run, const char* shape = "run") {
  return fmt::format("class='{} c{} d{}' data-run='{}'", shape, run.style % 7, run.style % 4, run.style);
}

std::string chart(const std::string& head, const std::string& x_label, const std::string& y_label,
                  const std::vector<Curve>& curves, const plant::Rig& rig, double floor = 0.0) {
  output::Panel panel{
      .x = {left, still_width - right}, .y = {still_height - bottom, top, floor}, .words_px = left - 11.0};
  output::Scale &x = panel.x, &y = panel.y;
  hold(curves, panel);
  if (x.low > x.high) return "";
  if (floor > 0.0) y.hold(-1.5 * floor), y.hold(1.5 * floor);
  for (output::Scale* scale : {&x, &y}) scale->widen(1e-6 + 2e-3 * std::abs(scale->high));
  std::string svg = fmt::format("<svg role='img' viewBox='0 0 {} {}' {}{}{}>\n", still_width, still_height,
                                head, attribute('x', x), attribute('y', y));
  svg += axes_svg(panel, x_label, y_label, rig);
  for (const auto& curve : curves)
    if (curve.shown) svg += curve_svg(curve, panel);
  if (floor > 0.0) svg += floor_svg(panel);
  return svg + "</svg>\n";
}

}  // namespace

std::size_t ticks_looked_at(std::size_t runs) {
  return std::clamp<std::size_t>(50000 / std::max<std::size_t>(runs, 1), 100, 4000);
}

std::string curve_svg(const Curve& curve, const output::Panel& panel) {
  std::string d;
  double last_x = 0.0, last_y = 0.0;
  bool down = false;
  for (const auto& [at_x, at_y] : curve.points) {
    if (!std::isfinite(at_x + at_y)) {
      down = false;
      continue;
    }
    const double to_x = panel.x.px(at_x), to_y = panel.y.px(at_y);
    if (down && std::hypot(to_x - last_x, to_y - last_y) < 0.8) continue;
    d +=
        fmt::format("{}{:.1f} {:.1f}{}", down && !curve.dots ? 'L' : 'M', to_x, to_y, curve.dots ? "h0" : "");
    down = true;
    last_x = to_x, last_y = to_y;
  }
  return d.empty() ? "" : fmt::format("<path {} d='{}'/>\n", curve.kind, d);
}

std::string axes_svg(const output::Panel& panel, const std::string& x_label, const std::string& y_label,
                     const plant::Rig& rig) {
  const auto numbers = [](const output::Scale& scale, int parts, double factor, const std::string& label) {
    auto ticks = round_numbers(scale, parts, factor);
    if (label.empty())
      for (output::Tick& tick : ticks) tick.text.clear();
    return ticks;
  };
  return in_units(x_label, rig,
                  [&](double factor, const std::string& label) {
                    return panel.across(numbers(panel.x, 6, factor, label), label);
                  }) +
         in_units(y_label, rig, [&](double factor, const std::string& label) {
           return panel.upwards(numbers(panel.y, 5, factor, label), label);
         });
}

void hold(const std::vector<Curve>& curves, output::Panel& panel) {
  for (const auto& curve : curves)
    for (const auto& [at_x, at_y] : curve.points)
      if (std::isfinite(at_x + at_y)) panel.x.hold(at_x), panel.y.hold(at_y);
}

std::vector<Curve> curves_over_time(const Group& group, const Plot& plot, const plant::Rig& rig,
                                    std::size_t most) {
  std::vector<Curve> curves;
  const auto add = [&](const std::string& kind, const AtTick* at, std::size_t ticks) {
    if (at == nullptr) return;
    Curve curve{.kind = kind};
    for (std::size_t k = 0; k < ticks; k += stride(ticks, most))
      curve.points.emplace_back(group.time_s.empty() ? static_cast<double>(k) * rig.tick_s : group.time_s[k],
                                (*at)(k));
    curves.push_back(std::move(curve));
  };
  for (const auto& line : plot.lines) {
    if (line.given) add("class='given'", find(group.given, line.key), group.ticks);
    if (line.given || !line.main) continue;
    for (const auto& run : group.runs) add(run_class(run), find(run.quantities, line.key), run.ticks);
  }
  return curves;
}

std::vector<Curve> curves_of(const Group& group, const Loop& loop, std::size_t most, const Run* only) {
  std::vector<Curve> curves;
  const AtTick *measured_x = find(group.given, loop.given_x), *measured_y = find(group.given, loop.given_y);
  if (measured_x != nullptr && measured_y != nullptr) {
    Curve curve{.kind = "class='given'"};
    for (std::size_t k = 0; k < group.ticks; k += stride(group.ticks, most))
      curve.points.emplace_back((*measured_x)(k), (*measured_y)(k));
    curves.push_back(std::move(curve));
  }
  for (const auto& run : group.runs) {
    const AtTick *x = find(group, run, loop.x), *y = find(group, run, loop.y);
    if (x == nullptr || y == nullptr) continue;
    Curve curve{.kind = run_class(run, loop.dots ? "dots" : "run"),
                .dots = loop.dots,
                .shown = only == nullptr || only == &run};
    for (std::size_t k = 0; k < run.ticks; k += stride(run.ticks, most))
      curve.points.emplace_back((*x)(k), (*y)(k));
    curves.push_back(std::move(curve));
  }
  return curves;
}

std::string still_svg(const Group& group, const Plot& plot, const plant::Rig& rig, std::size_t most) {
  return chart(fmt::format("aria-label='{}, {}'", escaped(plot.title), escaped(group.name)), "time in s",
               plot.unit, curves_over_time(group, plot, rig, most), rig, plot.floor);
}

std::string loop_svg(const Group& group, const Loop& loop, const plant::Rig& rig, std::size_t most,
                     const Run* only) {
  const std::string head = fmt::format(
      "class='loop' data-loop='{}' data-keys='{} {}'{} aria-label='{}, {}{}'", loop.id, loop.x, loop.y,
      only == nullptr ? "" : fmt::format(" data-only='{}'", only->style), escaped(loop.title),
      escaped(group.name), only == nullptr ? "" : ", " + escaped(only->name));
  return chart(head, loop.x_label, loop.y_label, curves_of(group, loop, most, only), rig);
}

}  // namespace mckibben::report
