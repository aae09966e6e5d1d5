// Axes and lines; see the header.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <sim/output/svg.hpp>
#include <sim/report/length.hpp>
#include <sim/report/still.hpp>

namespace mckibben::report {
namespace {

using output::escaped;

constexpr double picture_width = 460.0, picture_height = 300.0, left = 66.0, right = 10.0, top = 10.0,
                 bottom = 42.0;

struct Curve {
  std::string kind;  // class and data-run
  bool dots = false;
  std::vector<std::pair<double, double>> points{};
};

/// Linear; or, with a floor, linear within it and logarithmic beyond.
struct Axis {
  double from_px, to_px, floor = 0.0, low = 1e300, high = -1e300;

  void hold(double value) { low = std::min(low, value), high = std::max(high, value); }
  void close() {
    if (low > high) low = 0.0, high = 1.0;
    const double margin = std::max(0.04 * (high - low), 1e-6 + 2e-3 * std::abs(high));
    low -= margin, high += margin;
  }
  double bent(double value) const { return floor > 0.0 ? std::asinh(value / floor) : value; }
  double px(double value) const {
    return from_px + (to_px - from_px) * (bent(value) - bent(low)) / (bent(high) - bent(low));
  }

  /// Numbers of a unit of which one value is `factor`.
  template <class Draw>
  void ticks(int parts, double factor, const Draw& draw) const {
    if (floor > 0.0) {  // 0 and powers of ten
      draw(px(0.0), "0");
      const double first = std::pow(10.0, std::ceil(std::log10(floor * factor) + 0.2));
      for (double power = first; power <= factor * std::max(-low, high); power *= 10.0)
        for (const double value : {-power, power})
          if (factor * low <= value && value <= factor * high)
            draw(px(value / factor), fmt::format("{:g}", value));
      return;
    }
    const double step = output::tick_step(factor * (high - low), parts);
    for (double i = std::ceil(factor * low / step); i <= std::floor(factor * high / step); i += 1.0)
      draw(px(i * step / factor), fmt::format("{:.4g}", i * step + 0.0));  // + 0.0 makes 0 of -0
  }
  std::string attribute(char name) const {
    return fmt::format(" data-{}='{} {} {} {}'", name, low, high, from_px, to_px);
  }
};

std::string path(const Curve& curve, const Axis& x, const Axis& y) {
  std::string d;
  double last_x = 0.0, last_y = 0.0;
  bool down = false;
  for (const auto& [at_x, at_y] : curve.points) {
    if (!std::isfinite(at_x + at_y)) {
      down = false;
      continue;
    }
    const double to_x = x.px(at_x), to_y = y.px(at_y);
    if (down && std::hypot(to_x - last_x, to_y - last_y) < 0.8) continue;
    d +=
        fmt::format("{}{:.1f} {:.1f}{}", down && !curve.dots ? 'L' : 'M', to_x, to_y, curve.dots ? "h0" : "");
    down = true;
    last_x = to_x, last_y = to_y;
  }
  return d.empty() ? "" : fmt::format("<path {} d='{}'/>\n", curve.kind, d);
}

/// Grid, numbers and label of an axis, drawn in a unit.
using InUnit = std::function<std::string(double factor, const std::string& label)>;

/// In mm and as ratios where that is what it shows.
std::string axis_svg(const std::string& label, const plant::Rig& rig, const InUnit& drawn) {
  if (label != ratio_unit) return drawn(1.0, label);
  return either(drawn(length_mm(rig), "height in mm"), drawn(1.0, label), "g");
}

std::string across(const Axis& x, double factor, const std::string& label) {
  std::string svg = fmt::format("<text x='{}' y='{}' text-anchor='middle'>{}</text>\n",
                                0.5 * (left + picture_width - right), picture_height - 8, escaped(label));
  x.ticks(6, factor, [&](double px, const std::string& text) {
    svg += fmt::format(
        "<path class='grid' d='M{0:.1f} {1}V{2}'/><text x='{0:.1f}' y='{3}' "
        "text-anchor='middle'>{4}</text>\n",
        px, top, picture_height - bottom, picture_height - bottom + 15, text);
  });
  return svg;
}

std::string upwards(const Axis& y, double factor, const std::string& label) {
  std::string svg =
      fmt::format("<text x='11' y='{0}' text-anchor='middle' transform='rotate(-90 11 {0})'>{1}</text>\n",
                  0.5 * (top + picture_height - bottom), escaped(label));
  y.ticks(5, factor, [&](double px, const std::string& text) {
    svg += fmt::format(
        "<path class='grid' d='M{0} {1:.1f}H{2}'/><text x='{3}' y='{4:.1f}' text-anchor='end'>{5}</text>\n",
        left, px, picture_width - right, left - 5, px + 4, text);
  });
  return svg;
}

std::string chart(const std::string& head, const std::string& x_label, const std::string& y_label,
                  const std::vector<Curve>& curves, const plant::Rig& rig, double floor = 0.0) {
  Axis x{left, picture_width - right}, y{picture_height - bottom, top, floor};
  bool any = false;
  for (const auto& curve : curves)
    for (const auto& [at_x, at_y] : curve.points)
      if (std::isfinite(at_x + at_y)) {
        x.hold(at_x);
        y.hold(at_y);
        any = true;
      }
  if (!any) return "";
  if (floor > 0.0) y.hold(-1.5 * floor), y.hold(1.5 * floor);
  x.close();
  y.close();
  std::string svg = fmt::format("<svg role='img' viewBox='0 0 {} {}' {}{}{}>\n", picture_width,
                                picture_height, head, x.attribute('x'), y.attribute('y'));
  svg += axis_svg(x_label, rig, [&x](double factor, const auto& label) { return across(x, factor, label); });
  svg += axis_svg(y_label, rig, [&y](double factor, const auto& label) { return upwards(y, factor, label); });
  for (const auto& curve : curves) svg += path(curve, x, y);
  if (floor > 0.0)
    svg += fmt::format(
        "<path class='floor' d='M{0} {1:.1f}H{2}M{0} {3:.1f}H{2}'/><text x='{4}' y='{5:.1f}' "
        "class='halo' text-anchor='end'>noise floor</text>\n",
        left, y.px(floor), picture_width - right, y.px(-floor), picture_width - right - 3, y.px(floor) - 4);
  return svg + "</svg>\n";
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

}  // namespace

std::size_t ticks_looked_at(std::size_t runs) {
  return std::clamp<std::size_t>(50000 / std::max<std::size_t>(runs, 1), 100, 4000);
}

std::string still_svg(const Group& group, const Plot& plot, const plant::Rig& rig, std::size_t most) {
  std::vector<Curve> curves;
  const auto add = [&](const std::string& kind, const AtTick* at, std::size_t ticks) {
    if (at == nullptr) return;
    Curve curve{.kind = kind};
    for (std::size_t k = 0; k < ticks; k += stride(ticks, most))
      curve.points.emplace_back(static_cast<double>(k) * rig.tick_s, (*at)(k));
    curves.push_back(std::move(curve));
  };
  for (const auto& line : plot.lines) {
    if (line.given) add("class='given'", find(group.given, line.key), group.ticks);
    if (line.given || !line.main) continue;
    for (const auto& run : group.runs) add(run_class(run), find(run.quantities, line.key), run.ticks);
  }
  return chart(fmt::format("aria-label='{}, {}'", escaped(plot.title), escaped(group.name)), "time in s",
               plot.unit, curves, rig, plot.floor);
}

std::string loop_svg(const Group& group, const Loop& loop, const plant::Rig& rig, std::size_t most) {
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
    Curve curve{.kind = run_class(run, loop.dots ? "dots" : "run"), .dots = loop.dots};
    for (std::size_t k = 0; k < run.ticks; k += stride(run.ticks, most))
      curve.points.emplace_back((*x)(k), (*y)(k));
    curves.push_back(std::move(curve));
  }
  const std::string head = fmt::format("class='loop' data-loop='{}' data-keys='{} {}' aria-label='{}, {}'",
                                       loop.id, loop.x, loop.y, escaped(loop.title), escaped(group.name));
  return chart(head, loop.x_label, loop.y_label, curves, rig);
}

}  // namespace mckibben::report
