// A panel for each quantity; see recognised.hpp.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/output/axes.hpp>
#include <sim/output/recognised.hpp>
#include <sim/output/svg.hpp>

namespace mckibben::output {
namespace {

using recognise::ColumnGuess, recognise::Recognised;

constexpr double drawn_width = 800.0, drawn_height = 150.0, drawn_left = 70.0, drawn_right = 20.0,
                 drawn_gap = 41.0;
constexpr std::size_t most_points = 1600;  // two for each pixel

/// A column of one run, over time or over rows.
struct Line {
  std::size_t run = 0;
  std::vector<double> x, y;
};

std::vector<double> times_of(const Recognised& found, std::size_t run, const ColumnGuess& guess) {
  if (const ColumnGuess* time = found.maps.front().find("time"); time != nullptr && !time->column.open()) {
    ColumnGuess clock = *time;
    if (guess.time) clock.column = *guess.time;
    return recognise::shown(found.tables[run], clock);
  }
  std::vector<double> rows(found.tables[run].columns.front().values.size());
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = static_cast<double>(k);
  return rows;
}

std::vector<Line> lines_of(const Recognised& found, const ColumnGuess& guess) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < found.runs.size(); ++i)
    if (found.runs[i].map == 0)
      lines.push_back({i, times_of(found, i, guess), recognise::shown(found.tables[i], guess)});
  return lines;
}

std::string drawn(const Line& line, const Panel& panel) {
  std::vector<std::size_t> rows;  // others lack it: the line goes on
  for (std::size_t k = 0; k < std::min(line.x.size(), line.y.size()); ++k)
    if (std::isfinite(line.x[k]) && std::isfinite(line.y[k])) rows.push_back(k);
  std::string path;
  for (std::size_t i = 0; i < rows.size(); i += 1 + rows.size() / most_points)
    path += fmt::format("{}{:.1f} {:.1f}", i > 0 ? "L" : "M", panel.x.px(line.x[rows[i]]),
                        panel.y.px(line.y[rows[i]]));
  return fmt::format("<path fill='none' stroke='{}' stroke-width='1.3' d='{}'/>\n",
                     colours[line.run % colours.size()], path);
}

/// Headings may say it themselves.
std::string in_its_unit(const ColumnGuess& guess) {
  const std::string unit = fmt::format("[{}]", guess.unit.value);
  return guess.column.value.find(unit) == std::string::npos ? guess.column.value + " " + unit
                                                            : guess.column.value;
}

std::string words_of(const ColumnGuess& guess) {
  std::string words = in_its_unit(guess);
  if (guess.zero) words += " - " + guess.zero->value;
  if (guess.zero && guess.factor) words = "(" + words + ")";
  if (guess.factor) words += " x " + guess.factor->value;
  return fmt::format("{}: {}{}", guess.quantity->key, words, guess.input ? ", drives the simulation" : "");
}

std::vector<std::string> heading_of(const ColumnGuess& guess) {
  return wrapped(words_of(guess), drawn_width, 12.0, true);
}

std::string panel_svg(const Recognised& found, const ColumnGuess& guess, double top_px) {
  Panel panel{.x = {drawn_left, drawn_left + drawn_width},
              .y = {top_px + drawn_height, top_px},
              .words_px = drawn_left - 10.0};
  const std::vector<Line> lines = lines_of(found, guess);
  for (const Line& line : lines) {
    for (const double x : line.x) panel.x.hold(x);
    for (const double y : line.y) panel.y.hold(y);
  }
  panel.x.widen();
  panel.y.widen();
  const std::vector<std::string> heading = heading_of(guess);
  std::string svg =
      lines_svg(heading, drawn_left, top_px - 8.0 - 15.0 * static_cast<double>(heading.size() - 1), 15.0,
                " font-weight='bold'") +
      panel.across(round_numbers(panel.x, 8), "") + panel.upwards(round_numbers(panel.y, 5), "") +
      panel.frame();
  for (const Line& line : lines) svg += drawn(line, panel);
  return svg;
}

std::string legend(const Recognised& found, Rows& rows) {
  std::string svg;
  for (std::size_t i = 0; i < found.runs.size(); ++i) {
    if (found.runs[i].map != 0) continue;
    const std::string name = found.runs[i].id + (found.runs[i].load ? ", " + found.runs[i].load->value : "");
    const auto [x_px, y_px] = rows.next(16.0 + width_px(name, 12.0));
    svg += fmt::format("<text x='{:.0f}' y='{:.0f}' fill='{}'>{}</text>\n", x_px, y_px,
                       colours[i % colours.size()], escaped(name));
  }
  return svg;
}

}  // namespace

std::string picture_of(const Recognised& found) {
  const ColumnGuess* time = found.maps.front().find("time");
  std::vector<const ColumnGuess*> drawn_ones;
  for (const ColumnGuess& guess : found.maps.front().columns)
    if (guess.quantity->key != "time" && !guess.column.open()) drawn_ones.push_back(&guess);
  Rows rows(drawn_left, drawn_left + drawn_width, 38.0);
  const std::string names = legend(found, rows);
  double top_px = rows.bottom_px() + 17.0;
  const std::string over = time == nullptr || time->column.open() ? "rows" : in_its_unit(*time);
  std::string svg =
      fmt::format("<text x='{}' y='20' font-weight='bold'>What was understood, over {}</text>\n", drawn_left,
                  escaped(over)) +
      names;
  for (const ColumnGuess* guess : drawn_ones) {
    top_px += 15.0 * static_cast<double>(heading_of(*guess).size());
    svg += panel_svg(found, *guess, top_px);
    top_px += drawn_height + drawn_gap;
  }
  return svg_begin(drawn_left + drawn_width + drawn_right, top_px) + svg + "</svg>\n";
}

}  // namespace mckibben::output
