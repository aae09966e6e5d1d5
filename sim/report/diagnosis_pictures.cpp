// Rows of labels, bars and cells; see the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <sim/diagnose/thresholds.hpp>
#include <sim/output/axes.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/diagnosis_pictures.hpp>
#include <sim/report/length.hpp>

namespace mckibben::report {
namespace {

using diagnose::Diagnosis;
using diagnose::full_name;
using output::escaped;
using output::rounded;

constexpr double width = 460.0;

std::string picture(double height_px, const std::string& says, const std::string& body) {
  const bool leads_on = body.find("<a ") != std::string::npos;
  return fmt::format("<svg role='{}' viewBox='0 0 {} {:.0f}' aria-label='{}'>\n{}</svg>\n",
                     leads_on ? "group" : "img", width, height_px, escaped(says), body);
}

std::string marked_label(double x, double y, std::string_view anchor, std::string_view svg,
                         std::string_view kind = "") {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' class='{}'>{}</text>\n", x, y, anchor,
                     kind, svg);
}

std::string label(double x, double y, std::string_view anchor, std::string_view text,
                  std::string_view kind = "") {
  return marked_label(x, y, anchor, escaped(text), kind);
}

/// An amount of what was judged, heights in the unit that the reader wants, as part of a label.
std::string amount(double value, const diagnose::Gap& gap, const plant::Rig& rig, bool sign = false) {
  return amount_html(value, gap.judged, rig, "tspan", sign);
}

std::string bar(double x, double y, double wide, double high, std::string_view kind) {
  return fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' class='{}'/>\n", x, y,
                     std::max(wide, 0.8), high, kind);
}

std::string stroke(double x1, double y1, double x2, double y2, std::string_view kind) {
  return fmt::format("<path d='M{:.1f} {:.1f}L{:.1f} {:.1f}' class='{}'/>\n", x1, y1, x2, y2, kind);
}

/// A cell coloured by a value from -1 (blue) over 0 (none) to 1 (orange).
std::string heat(double x, double y, double wide, double high, double part) {
  return fmt::format(
      "<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' class='heat {}' fill-opacity='{:.2f}'/>\n",
      x, y, wide, high, part > 0.0 ? "c1" : "c0", 0.55 * std::min(std::abs(part), 1.0));
}

/// Values of `list` with equal `key`, in the order in which the keys first come.
template <class List, class Key>
auto grouped(const List& list, const Key& key) {
  using Value = typename List::value_type;
  std::vector<std::pair<std::decay_t<decltype(key(list.front()))>, std::vector<const Value*>>> groups;
  for (const Value& value : list) {
    const auto same = [&](const auto& group) { return group.first == key(value); };
    auto at = std::find_if(groups.begin(), groups.end(), same);
    if (at == groups.end()) at = groups.insert(groups.end(), {key(value), {}});
    at->second.push_back(&value);
  }
  return groups;
}

/// The three models, told apart by colour and shape.
struct Model {
  const char *name, *colour;
  double diagnose::RunGap::*rmse;
  const char* shape;  ///< a path round 0, 0
};
constexpr std::array<Model, 3> compared_models{
    {{"nominal", "c1", &diagnose::RunGap::nominal_rmse, "m-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0"},
     {"recalibrated", "c3", &diagnose::RunGap::recalibrated_rmse, "m-4.5 -4.5h9v9h-9z"},
     {"corrected", "c0", &diagnose::RunGap::corrected_rmse, "m0 -6l6 6l-6 6l-6 -6z"}}};

std::string mark(double x, double y, const Model& model) {
  return fmt::format("<path class='mark {}' d='M{:.1f} {:.1f}{}'/>\n", model.colour, x, y, model.shape);
}

}  // namespace

std::string cell_html(const diagnose::Cell& cell, const plant::Rig& rig, std::string_view tag) {
  return cell.factor == "contraction" ? ratios_html(cell.cell, rig, tag) : text_html(cell.cell, rig, tag);
}

std::vector<Picture> where_pictures(const Diagnosis& diagnosis, const plant::Rig& rig) {
  constexpr double x0 = 140.0, wide = 132.0, x1 = 288.0, span = 124.0, pitch = 25.0;
  double most = std::max(diagnosis.gap.noise_floor, 1e-12);  // less than that is pale
  for (const auto& cell : diagnosis.where)
    if (cell.rows > 0) most = std::max(most, std::abs(cell.mean));
  std::vector<Picture> pictures;
  for (const auto& [factor, cells] : grouped(diagnosis.where, [](const auto& cell) { return cell.factor; })) {
    std::string svg = label(0, 14, "start", factor, "strong") +
                      label(x0 + 0.5 * wide, 14, "middle", "mean", "soft") +
                      label(x1, 14, "start", "share of the gap", "soft");
    double y = 22.0;
    for (const auto* cell : cells) {
      svg += marked_label(x0 - 8, y + 15, "end", cell_html(*cell, rig, "tspan"));
      if (cell->rows == 0) {
        svg += bar(x0, y, wide, 21.0, "empty") + label(x0 + 0.5 * wide, y + 15, "middle", "never visited");
      } else {
        svg += heat(x0, y, wide, 21.0, cell->mean / most);
        if (cell->significant) svg += bar(x0 + 1, y + 1, wide - 2, 19.0, "frame");
        svg += marked_label(x0 + 0.5 * wide, y + 15, "middle",
                            amount(cell->mean, diagnosis.gap, rig, true) + (cell->significant ? " *" : ""));
        svg += bar(x1, y + 4, cell->share_of_gap * span, 13.0, "bar");
        svg += label(x1 + cell->share_of_gap * span + 6, y + 15, "start",
                     fmt::format("{:.0f} %", 100.0 * cell->share_of_gap), "soft");
      }
      y += pitch;
    }
    pictures.push_back({"", picture(y, "Disagreement by " + factor, svg)});
  }
  return pictures;
}

std::vector<Picture> ranking_pictures(const Diagnosis& diagnosis, const plant::Rig& rig) {
  constexpr double x0 = 212.0, span = 200.0, digit_px = 7.0, least_share = 0.01;
  // What a fit made of it; where there is none, what the score promises.
  const auto fall = [](const diagnose::Ranked& one) { return one.refitted ? one.fall : one.score; };
  double most = 10.0 * diagnose::thresholds.tell.chance;
  for (const auto& one : diagnosis.ranking) most = std::max({most, one.fall, one.score});
  const auto length = [&](double value) { return span * std::log(std::max(value, 1.0)) / std::log(most); };
  const auto rounds = grouped(diagnosis.ranking, [](const auto& one) { return one.round; });
  std::vector<Picture> pictures;
  for (const auto& [round, all] : rounds) {
    const std::string heading = fmt::format("Round {}", round);
    std::string svg;
    if (rounds.size() > 1) svg += label(0, 14, "start", heading, "strong");
    const double begin = rounds.size() > 1 ? 20.0 : 0.0;
    double y = begin;
    const double limit = x0 + length(diagnose::thresholds.tell.chance);
    std::string bars;
    std::map<std::string, std::vector<std::string>> others;  // by outcome
    for (const auto* one : all) {
      if (!one->refitted &&
          (one->score < diagnose::thresholds.tell.chance || one->score < least_share * most)) {
        others[one->outcome].push_back(full_name(*one));
        continue;
      }
      const bool taken = one->outcome.starts_with("taken");
      bars += label(x0 - 8, y + 13, "end", full_name(*one), taken ? "strong" : "");
      const auto in_digits = [](double value) { return rounded(value, std::abs(value) < 100.0 ? 1 : 0); };
      const bool promised = one->refitted && one->score > one->fall;
      const double end = length(fall(*one)), reach = promised ? length(one->score) : end;
      if (promised) bars += bar(x0, y + 2, reach, 13.0, "empty");
      bars += bar(x0, y + 2, end, 13.0, !one->refitted ? "empty" : taken ? "bar c0" : "bar");
      const std::string words = in_digits(fall(*one)) + (promised ? " of " + in_digits(one->score) : "");
      const bool fits = x0 + reach + 5 + digit_px * static_cast<double>(words.size()) < width;
      bars += label(fits ? x0 + reach + 5 : width - 4, y + 13, fits ? "start" : "end", words, "soft halo");
      y += 21.0;
      if (!one->refitted) continue;
      bars += marked_label(width - 4, y + 7, "end",
                           escaped(one->outcome) + ": " + amount(one->held_out_rmse, diagnosis.gap, rig),
                           "soft halo");
      y += 17.0;
    }
    svg += stroke(limit, begin, limit, y, "floor") + bars;
    svg += label(limit + 4, y + 12, "start", "chance", "soft");
    std::string caption;
    for (const auto& [outcome, names] : others)
      caption +=
          fmt::format("{}Not drawn, {}: {}.", caption.empty() ? "" : " ", outcome, output::listed(names));
    if (y > begin) pictures.push_back({caption, picture(y + 16, "Candidates, " + heading, svg)});
  }
  return pictures;
}

std::string absorbed_svg(const Diagnosis& diagnosis) {
  constexpr double middle = 306.0, span = 140.0;
  double most = 1.0, y = 24.0;
  for (const auto& one : diagnosis.absorbed)
    most = std::max({most, std::abs(one.without), std::abs(one.with)});
  const double bottom = y + 26.0 * static_cast<double>(diagnosis.absorbed.size());
  std::string svg;
  const output::Scale scale{.from_px = middle - span, .to_px = middle + span, .low = -most, .high = most};
  for (const auto& [x, text] : output::round_numbers(scale, 6)) {
    const bool nothing = text == "0", below = text.front() == '-';
    svg += stroke(x, 18, x, bottom, nothing ? "axis" : "grid");
    svg += label(x, 12, "middle", nothing || below ? text : "+" + text, "soft");
  }
  for (const auto& one : diagnosis.absorbed) {
    svg += label(middle - span - 14, y + 15, "end", one.path);
    const auto from_middle = [&](double value, double at, std::string_view kind) {
      const double end = scale.px(value);
      svg += bar(std::min(middle, end), at, std::abs(end - middle), 8.0, kind);
    };
    from_middle(one.without, y + 3, "bar c3");
    from_middle(one.with, y + 12, "bar c0");
    y += 26.0;
  }
  return picture(bottom + 4, "Prior deviations by which nominal parameters are moved", svg);
}

std::string errors_svg(const std::vector<const diagnose::RunGap*>& runs, const diagnose::Gap& gap,
                       bool changed, const plant::Rig& rig) {
  const double noise_floor = gap.noise_floor;
  const auto shown = std::span(compared_models).first(changed ? 3 : 2);
  constexpr double x1 = 330.0, pitch = 24.0;
  const bool each = std::ranges::all_of(runs, [](const auto* run) { return run->held_out || run->left_out; });
  const auto name_of = [each](const diagnose::RunGap& run) {
    return run.id + (run.left_out ? ", left out" : run.held_out && !each ? ", held out" : "");
  };
  std::size_t longest = 0;
  for (const auto* run : runs) longest = std::max(longest, name_of(*run).size());
  const double x0 = std::clamp(16.0 + 8.2 * static_cast<double>(longest), 80.0, 240.0);
  double low = noise_floor > 0.0 ? noise_floor : 1e-4, high = low;
  for (const auto* run : runs)
    for (const auto& model : shown)
      if (const double rmse = run->*model.rmse; std::isfinite(rmse) && rmse > 0.0)
        low = std::min(low, std::max(rmse, 0.01 * high)), high = std::max(high, rmse);
  low *= 0.8, high *= 1.25;
  const auto x = [&](double rmse) {
    return x0 + (x1 - x0) * std::log(std::max(rmse, low) / low) / std::log(high / low);
  };
  double y = 62.0, key_x = x0;
  const double bottom = y + pitch * static_cast<double>(runs.size());
  std::string svg;
  for (const auto& model : shown) {
    svg += mark(key_x, 9, model) + label(key_x + 9, 14, "start", model.name);
    key_x += 26.0 + 7.2 * static_cast<double>(std::string_view(model.name).size());
  }
  svg += label(width, 48, "end", changed ? "nominal \u2192 corrected" : "nominal", "soft");
  const auto grid = [&](double factor, const char* unit) {  // of which a ratio of 1 has `factor`
    std::string lines;
    for (const auto& [value, is_power] : output::decades(low * factor, high * factor)) {
      const double at = x(value / factor);
      lines += stroke(at, 52, at, bottom, "grid");
      if (is_power) lines += label(at, 48, "middle", fmt::format("{:g}{}", value, unit), "soft");
    }
    return lines;
  };
  if (gap.judged == diagnose::Judged::contraction)
    svg += either(grid(length_mm(rig), " mm"), grid(1.0, ""), "g");
  else if (gap.judged == diagnose::Judged::force)
    svg += grid(1.0, " N");
  else if (gap.judged == diagnose::Judged::pressure)
    svg += grid(1e3 / plant::Pa_per_bar, " mbar");
  else
    svg += grid(1.0 / plant::degree_rad, " deg");
  if (noise_floor > 0.0) {
    svg += stroke(x(noise_floor), 36, x(noise_floor), bottom, "floor");
    svg +=
        marked_label(x(noise_floor) - 4, 33, "start", "noise floor " + amount(noise_floor, gap, rig), "soft");
  }
  for (std::size_t i = 0; i < runs.size(); ++i, y += pitch) {
    const auto& run = *runs[i];
    svg += fmt::format("<a href='#group-{0}' data-group='{0}'>", i) + bar(0, y, width, pitch, "row");
    svg += label(x0 - 12, y + 16, "end", name_of(run), run.held_out ? "strong" : "");
    double least = x1, most = x0;
    for (const auto& model : shown)
      if (const double rmse = run.*model.rmse; std::isfinite(rmse))
        least = std::min(least, x(rmse)), most = std::max(most, x(rmse));
    if (least < most) svg += stroke(least, y + 12, most, y + 12, "axis");
    for (const auto& model : shown)
      if (const double rmse = run.*model.rmse; std::isfinite(rmse)) svg += mark(x(rmse), y + 12, model);
    const std::string corrected = changed ? " \u2192 " + amount(run.corrected_rmse, gap, rig) : "";
    svg +=
        marked_label(width, y + 16, "end", amount(run.nominal_rmse, gap, rig) + corrected, "soft") + "</a>\n";
  }
  return picture(bottom + 4, "Errors of each run", svg);
}

}  // namespace mckibben::report
