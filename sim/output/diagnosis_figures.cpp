// Bars and curves; see the header. All pictures are 460 units wide, so that on a small screen their text
// stays readable; the page puts them side by side where there is room.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <sim/output/diagnosis_figures.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/svg.hpp>

namespace mckibben::output {
namespace {

using diagnose::RunGap;

constexpr double width = 460.0;

std::string picture(double height_px, const std::string& says, const std::string& body) {
  return fmt::format("<svg role='img' viewBox='0 0 {} {:.0f}' aria-label='{}'>\n{}</svg>\n", width, height_px,
                     escaped(says), body);
}

std::string label(double x, double y, std::string_view anchor, const std::string& text,
                  std::string_view kind = "") {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' class='{}'>{}</text>\n", x, y, anchor,
                     kind, escaped(text));
}

std::string bar(double x, double y, double wide, double high, std::string_view kind) {
  return fmt::format(
      "<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' class='{}' fill='currentColor'/>\n", x, y,
      std::max(wide, 0.8), high, kind);
}

std::string stroke(double x1, double y1, double x2, double y2, std::string_view kind) {
  return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' class='{}'/>\n", x1, y1, x2, y2,
                     kind);
}

/// A plane of values over time, drawn between x = 52 and the right edge.
struct Plane {
  double top, height, low, high, duration_s;
  static constexpr double left = 52.0, right = width - 6.0;

  double x(double time_s) const { return left + (right - left) * time_s / duration_s; }
  double y(double value) const { return top + height * (high - value) / (high - low); }

  std::string axes(double scale, bool times) const {
    std::string svg;
    const double step = tick_step((high - low) * scale, height > 100.0 ? 5 : 4);
    for (double v = std::ceil(low * scale / step) * step; v <= high * scale + 1e-9 * step; v += step) {
      svg += stroke(left, y(v / scale), right, y(v / scale), "grid");
      svg += label(left - 6, y(v / scale) + 4, "end",
                   fmt::format("{:.4g}", std::abs(v) < 1e-9 * step ? 0.0 : v), "small");
    }
    const double step_s = tick_step(duration_s, 5);
    for (double t = 0.0; times && t <= duration_s * (1 + 1e-9); t += step_s)
      svg += label(x(t), top + height + 15,
                   t == 0.0            ? "start"
                   : x(t) > right - 12 ? "end"
                                       : "middle",
                   fmt::format("{:g} s", t), "small");
    return svg;
  }

  /// A line through one value each tick; for each pixel the extreme ones.
  template <class Value>
  std::string line(std::size_t ticks, double tick_s, std::string_view kind, const Value& value) const {
    const auto per_pixel = std::max<std::size_t>(1, ticks / static_cast<std::size_t>(right - left));
    std::string points;
    const auto put = [&](std::size_t i) {
      if (std::isfinite(value(i)))
        points += fmt::format("{:.1f},{:.1f} ", x(static_cast<double>(i) * tick_s), y(value(i)));
    };
    for (std::size_t k = 0; k < ticks; k += per_pixel) {
      std::size_t least = k, most = k;
      for (std::size_t i = k; i < std::min(k + per_pixel, ticks); ++i) {
        if (value(i) < value(least)) least = i;
        if (value(i) > value(most)) most = i;
      }
      put(std::min(least, most));
      if (least != most) put(std::max(least, most));
    }
    return fmt::format("<polyline class='{}' points='{}'/>\n", kind, points);
  }
};

/// Smallest and largest finite value, a little apart.
std::array<double, 2> range_of(std::initializer_list<const std::vector<double>*> all) {
  double low = 1e300, high = -1e300;
  for (const auto* values : all)
    for (const double value : *values)
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  if (low > high) return {0.0, 1.0};
  const double margin = std::max(0.05 * (high - low), 1e-4);
  return {low - margin, high + margin};
}

std::vector<double> difference(const std::vector<double>& measured, const std::vector<double>& model) {
  std::vector<double> less;
  for (std::size_t k = 0; k < std::min(measured.size(), model.size()); ++k)
    less.push_back(measured[k] - model[k]);
  return less;
}

struct Model {
  std::string_view kind;
  double rmse;
};
std::array<Model, 3> models(const auto& errors) {
  return {{{"nominal", errors.nominal_rmse},
           {"recalibrated", errors.recalibrated_rmse},
           {"corrected", errors.corrected_rmse}}};
}

double largest(const auto& errors) {
  double most = 0.0;
  for (const auto& model : models(errors))
    if (std::isfinite(model.rmse)) most = std::max(most, model.rmse);
  return most;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '&':
        safe += "&amp;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string gap_svg(const diagnose::Diagnosis& diagnosis, const plant::Rig& rig) {
  constexpr double x0 = 100.0, span = 200.0, pitch = 30.0;
  const auto& gap = diagnosis.gap;
  const double floor = gap.noise_floor, scale = span / std::max({largest(gap), floor, 1e-12});
  std::string svg;
  double y = 26.0;
  for (const Model& model : models(gap)) {
    svg += label(x0 - 8, y + 15, "end", std::string(model.kind));
    svg += bar(x0, y, model.rmse * scale, 21.0, model.kind);
    const std::string times = floor > 0.0 ? fmt::format(" ({:.2g} x floor)", model.rmse / floor) : "";
    svg += label(x0 + model.rmse * scale + 6, y + 15, "start", height(model.rmse, rig) + times, "small");
    y += pitch;
  }
  svg += stroke(x0 + floor * scale, 18, x0 + floor * scale, y, "floor");
  svg += label(std::max(x0 + floor * scale, x0), 13, "start", "noise floor " + height(floor, rig), "small");
  return picture(y + 4, "Errors on the runs held out", svg);
}

std::string runs_svg(const diagnose::Diagnosis& diagnosis, const plant::Rig& rig) {
  constexpr double x0 = 118.0, span = 200.0;
  const double floor = diagnosis.gap.noise_floor;
  double most = std::max(floor, 1e-12), y = 4.0;
  for (const auto& run : diagnosis.runs) most = std::max(most, largest(run));
  std::string svg;
  const auto group = [&](const char* title, const auto& belongs) {
    bool first = true;
    for (const RunGap& run : diagnosis.runs) {
      if (!belongs(run)) continue;
      if (first) svg += label(0, y + 14, "start", title, "strong");
      if (std::exchange(first, false)) y += 22.0;
      svg += label(x0 - 8, y + 15, "end", fmt::format("{}, {:g} kg", run.id, run.load_kg), "small");
      double at = y;
      for (const Model& model : models(run)) {
        svg += bar(x0, at, std::isfinite(model.rmse) ? model.rmse * span / most : 0.0, 6.0, model.kind);
        at += 7.0;
      }
      svg += stroke(x0 + floor * span / most, y - 3, x0 + floor * span / most, y + 23, "floor");
      svg += label(width, y + 15, "end",
                   height(run.nominal_rmse, rig) + " \u2192 " + height(run.corrected_rmse, rig), "small");
      y += 28.0;
    }
  };
  group("held out", [](const RunGap& run) { return run.held_out && !run.left_out; });
  group("training", [](const RunGap& run) { return !run.held_out && !run.left_out; });
  group("left out: data or label in doubt", [](const RunGap& run) { return run.left_out; });
  return picture(y, "Errors of each run", svg);
}

std::string run_svg(const RunGap& run, double noise_floor, const plant::Rig& rig) {
  const double duration_s = static_cast<double>(std::max<std::size_t>(run.measured.size(), 2)) * rig.tick_s;
  const double mm = rig.muscle.rest_length_m * 1e3;
  const auto [low, high] = range_of({&run.measured, &run.nominal, &run.corrected});
  const Plane motion{20.0, 170.0, low, high, duration_s};
  std::string svg = label(0, 12, "start", "height of the load, mm", "small") + motion.axes(mm, false);
  const auto draw = [&](const Plane& plane, const std::vector<double>& values, std::string_view kind) {
    svg += plane.line(values.size(), rig.tick_s, kind, [&](std::size_t k) { return values[k]; });
  };
  draw(motion, run.measured, "line measured");
  draw(motion, run.nominal, "line nominal dashed");
  draw(motion, run.corrected, "line corrected");

  const auto before = difference(run.measured, run.nominal), after = difference(run.measured, run.corrected);
  const auto [least, most] = range_of({&before, &after});
  const double reach = std::max({std::abs(least), std::abs(most), 2.0 * noise_floor});
  const Plane rest{216.0, 84.0, -reach, reach, duration_s};
  svg += label(0, 209, "start", "measured less model, mm; grey: noise floor", "small");
  svg += bar(Plane::left, rest.y(noise_floor), Plane::right - Plane::left,
             rest.y(-noise_floor) - rest.y(noise_floor), "noise");
  svg += rest.axes(mm, true);
  draw(rest, before, "line nominal");
  draw(rest, after, "line corrected");
  return picture(320, fmt::format("Run {}: measured, nominal and corrected", run.id), svg);
}

std::string absorbed_svg(const diagnose::Diagnosis& diagnosis) {
  constexpr double middle = 300.0, span = 150.0;
  double most = 1.0, y = 24.0;
  for (const auto& one : diagnosis.absorbed)
    most = std::max({most, std::abs(one.without), std::abs(one.with)});
  const double bottom = y + 26.0 * static_cast<double>(diagnosis.absorbed.size());
  std::string svg;
  const double step = tick_step(2.0 * most, 6);
  for (double v = -std::floor(most / step) * step; v <= most * (1 + 1e-9); v += step) {
    svg += stroke(middle + v * span / most, 18, middle + v * span / most, bottom,
                  std::abs(v) < 0.5 * step ? "axis" : "grid");
    svg += label(middle + v * span / most, 12, "middle",
                 std::abs(v) < 0.5 * step ? "0" : fmt::format("{:+.2g}", v), "small");
  }
  for (const auto& one : diagnosis.absorbed) {
    svg += label(142, y + 15, "end", one.path, "small");
    const auto from_middle = [&](double value, double at, std::string_view kind) {
      const double end = middle + value * span / most;
      svg += bar(std::min(middle, end), at, std::abs(end - middle), 8.0, kind);
    };
    from_middle(one.without, y + 1, "recalibrated");
    from_middle(one.with, y + 11, "corrected");
    y += 26.0;
  }
  return picture(bottom + 4, "Nominal parameters moved without and with the effects", svg);
}

}  // namespace mckibben::output
