// See the header.
#include <algorithm>

#include <fmt/format.h>

#include <sim/output/axes.hpp>
#include <sim/output/calibration_report.hpp>
#include <sim/output/svg.hpp>

namespace mckibben::output {
namespace {

constexpr double width = 640.0, height = 440.0, left = 90.0, right = 20.0, top = 62.0, bottom = 50.0;

std::string axes(const thesis::Figure& figure, const Panel& panel) {
  const std::string number = figure.number.empty() ? "" : "Figure " + figure.number + ": ";
  return fmt::format("<text x='{}' y='20' font-weight='bold'>{}{}</text>\n", left, number,
                     escaped(figure.title)) +
         panel.across(round_numbers(panel.x, 8), figure.x_label) +
         panel.upwards(round_numbers(panel.y, 6), figure.y_label) + panel.frame();
}

std::string curve_svg(const thesis::Figure& figure, const thesis::Curved& curve, const Panel& panel,
                      const char* colour) {
  const auto& xs = figure.columns[curve.x].values;
  const auto& ys = figure.columns[curve.y].values;
  std::string path;
  for (std::size_t i = curve.begin; i < std::min(curve.end, xs.size()); ++i)
    path += fmt::format("{}{:.1f} {:.1f}{}", curve.dots || path.empty() ? "M" : "L", panel.x.px(xs[i]),
                        panel.y.px(ys[i]), curve.dots ? "h0" : "");
  return fmt::format("<path fill='none' stroke='{}' stroke-width='{}' stroke-linecap='round' d='{}'/>\n",
                     colour, curve.dots ? (xs.size() > 200 ? 2.5 : 5.0) : 1.8, path);
}

}  // namespace

std::string chart_svg(const thesis::Figure& figure) {
  Panel panel{.x = {left, width - right}, .y = {height - bottom, top}, .words_px = left - 16.0};
  for (const auto& curve : figure.curves)
    for (std::size_t i = curve.begin; i < std::min(curve.end, figure.columns[curve.x].values.size()); ++i) {
      panel.x.hold(figure.columns[curve.x].values[i]);
      panel.y.hold(figure.columns[curve.y].values[i]);
    }
  panel.x.widen();
  panel.y.widen();
  std::string svg = svg_begin(width, height) + axes(figure, panel);
  double legend_px = left, legend_row_px = 38.0;
  for (std::size_t c = 0; c < figure.curves.size(); ++c) {
    const auto& curve = figure.curves[c];
    const char* colour = colours[c % colours.size()];
    svg += curve_svg(figure, curve, panel, colour);
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
