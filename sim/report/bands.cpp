// See the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <plant/geometry.hpp>
#include <sim/domain/number.hpp>
#include <sim/output/axes.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/bands.hpp>
#include <sim/report/html.hpp>
#include <sim/report/length.hpp>

namespace mckibben::report {
namespace {

using output::escaped;

constexpr double whole_px = 460.0, axis_to_px = 372.0, first_px = 24.0, row_px = 18.0;

/// Errors on a logarithmic axis.
struct Axis {
  double from_px = 0.0;
  double low = 1e300, high = 0.0;

  void hold(double rmse) {
    if (!(rmse > 0.0)) return;
    low = std::min(low, rmse);
    high = std::max(high, rmse);
  }
  double px(double rmse) const {
    return from_px + (axis_to_px - from_px) * std::log(std::max(rmse, low) / low) / std::log(high / low);
  }
  std::string grid(double bottom, double factor, const char* unit) const {
    std::string lines;
    for (const auto& [value, is_power] : output::decades(low * factor, high * factor)) {
      const double at = px(value / factor);
      lines += fmt::format("<path d='M{0:.1f} {1}V{2:.1f}' class='grid'/>\n", at, first_px, bottom);
      if (is_power)
        lines += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle' class='soft'>{:g}{}</text>\n", at,
                             first_px - 6.0, value, unit);
    }
    return lines;
  }
};

std::string name_of(const run::RobustRow& row) {
  return fmt::format("{} kg, {}", domain::write_kg(row.load_kg), row.controller);
}

std::string drawn_row(const run::RobustRow& row, double nominal, std::size_t style, const Axis& axis,
                      double y) {
  std::string svg = fmt::format("<text x='{}' y='{:.1f}' text-anchor='end' class='soft'>{}</text>\n",
                                axis.from_px - 8.0, y + 4.0, escaped(name_of(row)));
  if (row.rmse)
    svg += fmt::format(
        "<g class='c{0}'><path class='bar' d='M{1:.1f} {2:.1f}H{3:.1f}v7H{1:.1f}z' "
        "fill-opacity='0.45'/><path "
        "class='bar' d='M{4:.1f} {5:.1f}h2v11h-2z'/></g>\n",
        style % 7, axis.px(row.rmse->low), y - 3.5,
        std::max(axis.px(row.rmse->high), axis.px(row.rmse->low) + 1.0), axis.px(row.rmse->median) - 1.0,
        y - 5.5);
  if (nominal > 0.0)
    svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3' class='given'/>\n", axis.px(nominal), y);
  return svg +
         fmt::format("<text x='{}' y='{:.1f}' text-anchor='end' class='{}'>{}</text>\n", whole_px, y + 4.0,
                     row.failures > 0 ? "strong" : "soft",
                     row.failures > 0 ? fmt::format("{} of {} fail", row.failures, row.rigs) : "none fails");
}

std::string picture(const domain::Scenario& scenario, const run::Comparison& comparison) {
  Axis axis;
  std::size_t longest = 0;
  for (const run::RobustRow& row : comparison.robustness) longest = std::max(longest, name_of(row).size());
  axis.from_px = std::clamp(10.0 + 7.0 * static_cast<double>(longest), 90.0, 250.0);
  for (std::size_t i = 0; i < comparison.robustness.size(); ++i) {
    if (const auto& band = comparison.robustness[i].rmse) axis.hold(band->low), axis.hold(band->high);
    if (comparison.runs[i].failure.empty()) axis.hold(comparison.runs[i].metrics.rmse);
  }
  if (axis.high == 0.0) return "";
  axis.low *= 0.8, axis.high *= 1.25;
  const double bottom = first_px + row_px * static_cast<double>(comparison.robustness.size()) + 6.0;
  std::string svg =
      either(axis.grid(bottom, length_mm(scenario.rig), " mm"), axis.grid(bottom, 1.0, ""), "g");
  for (std::size_t i = 0; i < comparison.robustness.size(); ++i) {
    const auto& described = comparison.runs[i];
    svg +=
        drawn_row(comparison.robustness[i], described.failure.empty() ? described.metrics.rmse : 0.0,
                  i % scenario.controllers.size(), axis, first_px + row_px * (static_cast<double>(i) + 0.7));
  }
  return fmt::format("<svg role='img' viewBox='0 0 {} {:.0f}' aria-label='Error bands'>\n{}</svg>\n",
                     whole_px, bottom + 4.0, svg);
}

}  // namespace

Chapter robustness(const domain::Scenario& scenario, const run::Comparison& comparison) {
  if (comparison.robustness.empty()) return {};
  std::string why;
  for (const run::RobustRow& row : comparison.robustness)
    if (!row.why.empty())
      why += fmt::format("<p>No result: {}: {}</p>\n", escaped(name_of(row)), escaped(row.why));
  return {
      "On rigs that are not quite as described",
      fmt::format("<p>{} rigs were drawn within the ± of {}. Each controller was made for the "
                  "described rig. A limit cycle, an end of the current for more than {:.0f} % of the time, a "
                  "contraction above {:.2f} or no result is a failure.</p>\n",
                  scenario.robustness.rigs, escaped(fmt::format("{}", fmt::join(comparison.drawn, ", "))),
                  100.0 * run::saturated_share, plant::risky_contraction_ratio) +
          why +
          figures_html(
              {{"Root mean square errors: bars hold 90 % of the rigs, a stroke is their median, a ring "
                "the rig as described.",
                picture(scenario, comparison)}})};
}

}  // namespace mckibben::report
