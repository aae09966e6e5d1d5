// Order of the page, and what the script is told.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include <sim/input/fields_json.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/files.hpp>
#include <sim/report/html.hpp>
#include <sim/report/in_script.hpp>
#include <sim/report/length.hpp>
#include <sim/report/pack.hpp>
#include <sim/report/still.hpp>

namespace mckibben::report {
namespace {

using input::Json;
using output::escaped;

Json plot_json(const Plot& plot) {
  Json lines = Json::array();
  for (const auto& line : plot.lines)
    lines.push_back({{"key", line.key}, {"label", line.label}, {"given", line.given}, {"main", line.main}});
  return {
      {"id", plot.id}, {"title", plot.title}, {"unit", plot.unit}, {"lines", lines}, {"floor", plot.floor}};
}

Json packed_json(const Packed& packed) {
  return {{"low", packed.low}, {"step", packed.step}, {"bits", packed.bits}};
}

/// Times of the points that `pack` makes.
Json times_json(const std::vector<double>& time_s, std::size_t per_column) {
  Json times = Json::array();
  for (std::size_t k = 0; k < time_s.size(); k += per_column) {
    times.push_back(time_s[k]);
    if (per_column > 1) times.push_back(time_s[std::min(k + per_column / 2, time_s.size() - 1)]);
  }
  return times;
}

/// Keys of what the page draws, in plots, loops and the picture of the rig.
std::set<std::string> drawn_keys(const Contents& contents) {
  std::set<std::string> keys;
  for (const char* key : {"angle", "contraction_ratio", "current", "command", "force", "muscle_pressure",
                          "reference_pressure", "tension", "valve_pressure"})
    for (const char* muscle : {"", "_1", "_2"}) keys.insert(std::string(key) + muscle);
  for (const Plot& plot : contents.plots)
    for (const Line& line : plot.lines) keys.insert(line.key);
  for (const Loop& loop : contents.loops) keys.insert({loop.x, loop.y});
  return keys;
}

Json group_json(const Group& group, std::size_t all_runs, const std::set<std::string>& drawn) {
  const std::size_t per_column = ticks_per_column(group.ticks, all_runs);
  Json entry{{"name", group.name},      {"load_kg", group.load_kg},
             {"ticks", group.ticks},    {"ticks_per_column", per_column},
             {"given", Json::object()}, {"runs", Json::array()}};
  if (group.rmse) entry["rmse"] = *group.rmse;
  if (!group.time_s.empty()) entry["times"] = times_json(group.time_s, per_column);
  for (const auto& quantity : group.given)
    entry["given"][quantity.key] = packed_json(pack(quantity.at, group.ticks, group.ticks, per_column));
  for (const auto& run : group.runs) {
    Json values = Json::object();
    for (const auto& quantity : run.quantities)
      if (drawn.contains(quantity.key))
        values[quantity.key] = packed_json(pack(quantity.at, group.ticks, run.ticks, per_column));
    entry["runs"].push_back({{"name", run.name}, {"style", run.style}, {"values", values}});
  }
  return entry;
}

std::size_t runs_of(const Contents& contents) {
  std::size_t runs = 0;
  for (const auto& group : contents.groups) runs += group.runs.size();
  return runs;
}

std::string data_of(const Contents& contents) {
  Json data{{"tick_s", contents.rig.tick_s},
            {"rig", drawn_rig_json(contents.rig, contents.gauge)},
            {"drawn", contents.drawn}};
  for (const auto& plot : contents.plots) data["plots"].push_back(plot_json(plot));
  const std::set<std::string> drawn = drawn_keys(contents);
  for (const auto& group : contents.groups)
    data["groups"].push_back(group_json(group, runs_of(contents), drawn));
  return in_script(data);
}

std::string key(const char* kind) {
  return fmt::format("<svg viewBox='0 0 34 10' aria-hidden='true'><path class='{}' d='M0 5H34'/></svg>",
                     kind);
}

/// Of more runs than can be told apart in one picture, one for each with the same axes.
std::string loop_html(const Group& group, const Loop& loop, const plant::Rig& rig, std::size_t most) {
  constexpr std::size_t told_apart = 2;
  std::string svg;
  if (group.runs.size() <= told_apart) svg = loop_svg(group, loop, rig, most);
  if (!svg.empty())
    return fmt::format("<figure>\n{}<figcaption>{}</figcaption></figure>\n", svg, escaped(loop.title));
  for (const Run& run : group.runs)
    if (group.runs.size() > told_apart)
      if (const std::string one = loop_svg(group, loop, rig, most, &run); !one.empty())
        svg += fmt::format("<figure data-run='{}'>\n{}<figcaption>{}</figcaption></figure>\n", run.style, one,
                           escaped(run.name));
  if (svg.empty()) return "";
  return fmt::format("<div class='multiples'><p class='title'>{}</p>\n{}</div>\n", escaped(loop.title), svg);
}

/// What is there without scripts: loops of every group, and plots that are wanted as pictures.
std::string stills(const Contents& contents) {
  std::string html;
  const std::size_t most = ticks_looked_at(runs_of(contents));
  for (std::size_t g = 0; g < contents.groups.size(); ++g) {
    const Group& group = contents.groups[g];
    html += fmt::format("<section class='group' id='group-{0}' data-group='{0}'>\n<h3>{1}</h3>\n", g,
                        escaped(group.name));
    html += "<p class='keys still'>";
    if (const Line& first = contents.plots.front().lines.front(); first.given)
      html += "<span>" + key("given") + escaped(first.label) + "</span>";
    for (const auto& run : group.runs)
      html += fmt::format("<span class='c{} d{}'>{}{}</span>", run.style % 7, run.style % 4, key("run"),
                          escaped(run.name));
    html += "</p>\n<div class='pictures'>\n";
    for (const Plot& plot : contents.plots)
      if (plot.still)
        html += fmt::format("<figure class='still'>\n{}<figcaption>{}</figcaption></figure>\n",
                            still_svg(group, plot, contents.rig, most), escaped(plot.title));
    for (const auto& loop : contents.loops) html += loop_html(group, loop, contents.rig, most);
    html += "</div>\n</section>\n";
  }
  return html;
}

/// Of what is printed only where the reader asks for all.
constexpr const char* on_screen = " class='on-screen'";

std::string chapters_html(const std::vector<Chapter>& chapters) {
  std::string html;
  for (const auto& chapter : chapters)
    if (!chapter.html.empty())
      html += fmt::format("<section{}><h2>{}</h2>\n{}</section>\n", chapter.on_paper ? "" : on_screen,
                          escaped(chapter.title), chapter.html);
  return html;
}

/// What moves time and chooses runs; hidden without the script.
constexpr const char* controls =
    "<div class='controls live-only'><label>Show <select id='group'></select></label>\n"
    "<button id='play' type='button'>Play</button>\n"
    "<select id='speed' aria-label='Speed'><option value='0.25'>1/4 x</option><option value='1' selected>1 "
    "x</option><option value='4'>4 x</option><option value='16'>16 x</option></select>\n"
    "<input id='time' type='range' min='0' step='any' aria-label='Time'>\n"
    "<output id='clock'></output>\n"
    "<button id='whole' type='button'>Whole run</button></div>\n";

/// The rig, the readout, and where the script puts its plots.
std::string rig_and_plots(const Contents& contents) {
  return "<div class='stage'>\n<figure class='live-only'><svg id='rig' role='img' aria-label='The rig at the "
         "time of the cursor'></svg>\n<figcaption id='rig-caption'></figcaption></figure>\n" +
         rig_html(contents) +
         "<div class='readout'>\n<div "
         "class='wide result live-only' tabindex='0'><table id='readout'></table></div>\n"
         "<p class='small live-only'>Tick runs to compare; the round mark chooses the one that is drawn. "
         "Move over a plot to set the time, drag to zoom, double-click to see the whole run. Keys: space "
         "plays, left and right step.</p>\n</div>\n</div>\n<div id='plots' class='live-only'></div>\n";
}

/// One box: of several the first, the others when asked for.
std::string warnings_html(const Contents& contents) {
  const auto& warnings = contents.warnings;
  if (warnings.empty()) return "";
  const auto shown = [&](const std::string& text) { return text_html(text, contents.rig); };
  const std::string first = "<b>Warning:</b> " + shown(warnings.front());
  if (warnings.size() == 1) return "<p class='warning'>" + first + "</p>\n";
  std::string html =
      fmt::format("<div class='warning'><p>{}</p>\n<details><summary>{} more warning{}</summary><ul>\n",
                  first, warnings.size() - 1, warnings.size() == 2 ? "" : "s");
  for (std::size_t i = 1; i < warnings.size(); ++i) html += "<li>" + shown(warnings[i]) + "</li>\n";
  return html + "</ul></details></div>\n";
}

}  // namespace

std::string figures_html(const std::vector<Picture>& pictures, bool wide) {
  std::string html = fmt::format("<div class='drawn{}'>\n", wide ? "" : " pictures");
  for (const auto& picture : pictures)
    html += "<figure>\n" + picture.svg +
            (picture.caption.empty() ? "" : "<figcaption>" + escaped(picture.caption) + "</figcaption>") +
            "</figure>\n";
  return html + "</div>\n";
}

std::string html_of(const Contents& contents) {
  const bool runs = !contents.groups.empty();
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n"
      "<meta name='viewport' content='width=device-width,initial-scale=1'>\n<title>{}</title>\n",
      escaped(contents.title));
  html += fmt::format("<style>\n{}\n{}{}</style>\n", runs ? uplot_css : "", picture_css, page_css);
  if (runs) html += "<script>document.documentElement.classList.add('live')</script>\n";
  html += "</head>\n<body>\n<main>\n";
  if (contents.lengths) html += unit_switch;
  html +=
      fmt::format("<p class='small'>{}</p>\n<h1{}>{}</h1>\n<p class='lead'>{}</p>\n", escaped(contents.about),
                  contents.handed_out ? " id='of-folder'" : "", escaped(contents.title), contents.sentence);
  html += contents.opening;
  html += "<div class='wide result' tabindex='0'>\n" + contents.table + "</div>\n";
  html += warnings_html(contents);
  html += "<details><summary>All numbers, as printed</summary><pre>" + escaped(contents.details) +
          "</pre></details>\n";
  html += chapters_html(contents.chapters);
  if (runs)
    html += fmt::format("<section{}><h2 id='runs'>The rig and its runs</h2>\n",
                        contents.short_on_paper ? on_screen : "") +
            controls + rig_and_plots(contents) +
            "<h2>Loops<span class='still'> and plots over time</span></h2>\n" + stills(contents) +
            "</section>\n";
  html += chapters_html(contents.later_chapters);
  if (contents.short_on_paper)
    html +=
        "<p class='small'><label><input type='checkbox' id='all-on-paper'> Print all of this page, not only "
        "its "
        "beginning, what was changed, the gap and what to measure next</label></p>\n";
  html += fmt::format("<p class='small'>mckibben {}. {}</p>\n", MCKIBBEN_VERSION,
                      text_html(contents.beside, contents.rig));
  if (runs)
    html += fmt::format(
        "<details class='small'><summary>Licence of uPlot, which draws the plots over "
        "time</summary><pre>{}</pre></details>\n",
        escaped(uplot_licence));
  html += "</main>\n";
  if (runs) {
    html += "<script type='application/json' id='data'>" + data_of(contents) + "</script>\n";
    html += fmt::format("<script>\n{}\n</script>\n<script>\n'use strict';\n", uplot_js);
    for (const auto& part : {data_js, plots_js, loops_js, rig_js, pair_js, lever_js, page_js}) html += part;
    html += "</script>\n";
  }
  return html + "</body>\n</html>\n";
}

}  // namespace mckibben::report
