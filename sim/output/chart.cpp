// See the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/output/chart.hpp>
#include <sim/output/svg.hpp>

namespace mckibben::output {
namespace {

constexpr double width = 640.0, height = 440.0, left = 90.0, right = 20.0, top = 62.0, bottom = 50.0;

/// One axis: which values lie between which pixels.
class Axis {
 public:
  Axis(double from_px, double to_px) : from_px_(from_px), to_px_(to_px) {}

  void hold(double value) {
    if (!std::isfinite(value)) return;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  void close() {
    if (low_ > high_) low_ = 0.0, high_ = 1.0;
    const double span = high_ - low_, tiny = 1e-9 * std::max(std::abs(low_), std::abs(high_));
    const double margin = span > tiny ? 0.04 * span : std::max(0.1 * std::abs(high_), 1e-12);
    low_ -= margin;
    high_ += margin;
  }
  double px(double value) const { return from_px_ + (to_px_ - from_px_) * (value - low_) / (high_ - low_); }

  template <class Draw>
  void ticks(int parts, const Draw& draw) const {
    const double step = tick_step(high_ - low_, parts);
    const auto first = std::ceil(low_ / step), last = std::floor(high_ / step);
    for (double i = first; i <= last; i += 1.0)  // + 0.0 makes 0 of -0
      draw(px(i * step), fmt::format("{:.4g}", i * step + 0.0));
  }

 private:
  double from_px_, to_px_;
  double low_ = 1e300, high_ = -1e300;
};

std::string frame(const thesis::Figure& figure, const Axis& x, const Axis& y) {
  std::string svg = svg_begin(width, height);
  const std::string number = figure.number.empty() ? "" : "Figure " + figure.number + ": ";
  svg += fmt::format("<text x='{}' y='20' font-weight='bold'>{}{}</text>\n", left, number,
                     escaped(figure.title));
  x.ticks(8, [&](double px, const std::string& text) {
    svg += fmt::format(
        "<line x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}' stroke='#ddd'/><text x='{0:.1f}' y='{3}' "
        "text-anchor='middle'>{4}</text>\n",
        px, top, height - bottom, height - bottom + 16, text);
  });
  y.ticks(6, [&](double px, const std::string& text) {
    svg += fmt::format(
        "<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' stroke='#ddd'/><text x='{3}' y='{4:.1f}' "
        "text-anchor='end'>{5}</text>\n",
        left, width - right, px, left - 6, px + 4, text);
  });
  svg += fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#888'/>\n", left, top,
                     width - left - right, height - top - bottom);
  svg += fmt::format("<text x='{}' y='{}' text-anchor='middle'>{}</text>\n", 0.5 * (left + width - right),
                     height - 12, escaped(figure.x_label));
  const double middle = 0.5 * (top + height - bottom);
  return svg +
         fmt::format("<text x='16' y='{0}' text-anchor='middle' transform='rotate(-90 16 {0})'>{1}</text>\n",
                     middle, escaped(figure.y_label));
}

std::string curve_svg(const thesis::Figure& figure, const thesis::Curved& curve, const Axis& x, const Axis& y,
                      const char* colour) {
  const auto& xs = figure.columns[curve.x].values;
  const auto& ys = figure.columns[curve.y].values;
  std::string path;
  for (std::size_t i = curve.begin; i < std::min(curve.end, xs.size()); ++i)
    path += fmt::format("{}{:.1f} {:.1f}{}", curve.dots || path.empty() ? "M" : "L", x.px(xs[i]), y.px(ys[i]),
                        curve.dots ? "h0" : "");
  return fmt::format("<path fill='none' stroke='{}' stroke-width='{}' stroke-linecap='round' d='{}'/>\n",
                     colour, curve.dots ? (xs.size() > 200 ? 2.5 : 5.0) : 1.8, path);
}

}  // namespace

std::string chart_svg(const thesis::Figure& figure) {
  Axis x(left, width - right), y(height - bottom, top);
  for (const auto& curve : figure.curves)
    for (std::size_t i = curve.begin; i < std::min(curve.end, figure.columns[curve.x].values.size()); ++i) {
      x.hold(figure.columns[curve.x].values[i]);
      y.hold(figure.columns[curve.y].values[i]);
    }
  x.close();
  y.close();
  std::string svg = frame(figure, x, y);
  double legend_px = left, legend_row_px = 38.0;
  for (std::size_t c = 0; c < figure.curves.size(); ++c) {
    const auto& curve = figure.curves[c];
    const char* colour = colours[c % colours.size()];
    svg += curve_svg(figure, curve, x, y, colour);
    if (curve.label.empty()) continue;
    const double wide = 30.0 + 6.4 * static_cast<double>(curve.label.size());
    if (legend_px + wide > width) {
      legend_px = left;
      legend_row_px += 15.0;
    }
    svg += fmt::format("<text x='{:.0f}' y='{}' fill='{}'>{} {}</text>\n", legend_px, legend_row_px, colour,
                       curve.dots ? "●" : "—", escaped(curve.label));
    legend_px += wide;
  }
  return svg + "</svg>\n";
}

std::string csv_of(const thesis::Figure& figure) {
  std::string text;
  for (const auto& column : figure.columns) text += (text.empty() ? "" : ",") + column.name;
  text += '\n';
  for (std::size_t row = 0; row < figure.columns.front().values.size(); ++row) {
    for (std::size_t c = 0; c < figure.columns.size(); ++c)
      text += fmt::format("{}{}", c == 0 ? "" : ",", figure.columns[c].values[row]);
    text += '\n';
  }
  return text;
}

}  // namespace mckibben::output
