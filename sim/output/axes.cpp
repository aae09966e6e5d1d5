// Scales, numbers and lines; see the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/output/axes.hpp>
#include <sim/output/svg.hpp>

namespace mckibben::output {
namespace {

double bent(const Scale& scale, double value) {
  return scale.floor > 0.0 ? std::asinh(value / scale.floor) : value;
}

std::string grid_svg(const std::string& lines) {
  return lines.empty() ? "" : fmt::format("<path class='grid' stroke='#ddd' d='{}'/>\n", lines);
}

}  // namespace

double tick_step(double span, int parts) {
  const double raw = span / parts, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw) return factor * power;
  return 10.0 * power;
}

void Scale::hold(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

void Scale::widen(double least) {
  if (low > high) low = 0.0, high = 1.0;
  const double span = high - low, size = std::max(std::abs(low), std::abs(high));
  const double margin = span > 1e-9 * size ? 0.04 * span : std::max(0.1 * size, 1e-12);
  low -= std::max(margin, least);
  high += std::max(margin, least);
}

double Scale::px(double value) const {
  const double from = bent(*this, low), to = bent(*this, high);
  return from_px + (to_px - from_px) * (bent(*this, value) - from) / (to - from);
}

std::vector<Tick> round_numbers(const Scale& scale, int parts, double factor) {
  const double low = factor * scale.low, high = factor * scale.high;
  std::vector<Tick> ticks;
  if (scale.floor > 0.0) {
    ticks.push_back({scale.px(0.0), "0"});
    const double first = std::pow(10.0, std::ceil(std::log10(scale.floor * factor) + 0.2));
    for (double power = first; power <= std::max(-low, high); power *= 10.0)
      for (const double value : {-power, power})
        if (low <= value && value <= high)
          ticks.push_back({scale.px(value / factor), fmt::format("{:g}", value)});
    return ticks;
  }
  const double step = tick_step(high - low, parts), rounding = 1e-9;
  for (double i = std::ceil(low / step - rounding); i <= std::floor(high / step + rounding); i += 1.0)
    ticks.push_back({scale.px(i * step / factor), fmt::format("{:.4g}", i * step + 0.0)});  // 0, not -0
  return ticks;
}

std::vector<Decade> decades(double low, double high) {
  std::vector<Decade> lines;
  for (double power = std::pow(10.0, std::ceil(std::log10(low))); power <= high; power *= 10.0)
    for (const double value : {power, 2.0 * power, 5.0 * power})
      if (value <= high) lines.push_back({value, value == power});
  return lines;
}

std::string Panel::across(const std::vector<Tick>& ticks, const std::string& words) const {
  std::string lines, texts;
  for (const Tick& tick : ticks) {
    if (with_grid) lines += fmt::format("M{:.1f} {:.1f}V{:.1f}", tick.px, y.to_px, y.from_px);
    texts += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n", tick.px,
                         y.from_px + 16.0, tick.text);
  }
  if (!words.empty())
    texts += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
                         0.5 * (x.from_px + x.to_px), y.from_px + 36.0, escaped(words));
  return grid_svg(lines) + texts;
}

std::string Panel::upwards(const std::vector<Tick>& ticks, const std::string& words) const {
  std::string lines, texts;
  for (const Tick& tick : ticks) {
    if (with_grid) lines += fmt::format("M{:.1f} {:.1f}H{:.1f}", x.from_px, tick.px, x.to_px);
    texts += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='end'>{}</text>\n", x.from_px - 6.0,
                         tick.px + 4.0, tick.text);
  }
  if (!words.empty())
    texts += fmt::format(
        "<text x='{0:.1f}' y='{1:.1f}' text-anchor='middle' transform='rotate(-90 {0:.1f} "
        "{1:.1f})'>{2}</text>\n",
        x.from_px - words_px, 0.5 * (y.from_px + y.to_px), escaped(words));
  return grid_svg(lines) + texts;
}

std::string Panel::frame() const {
  return fmt::format(
      "<rect class='axis' x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='none' stroke='#888'/>\n",
      x.from_px, y.to_px, x.to_px - x.from_px, y.from_px - y.to_px);
}

std::string Panel::heading(const std::string& words) const {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' font-weight='bold'>{}</text>\n", x.from_px, y.to_px - 8.0,
                     escaped(words));
}

}  // namespace mckibben::output
