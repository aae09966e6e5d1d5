// The skeleton, which script fills; style and script are those of reports with what is live.

#include <fmt/format.h>

#include <sim/input/fields_json.hpp>
#include <sim/live/files.hpp>
#include <sim/live/page.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/files.hpp>
#include <sim/report/in_script.hpp>
#include <sim/report/length.hpp>

namespace mckibben::live {
namespace {

using input::Json;
using output::escaped;

Json dial_json(const Dial& dial) {
  return {{"least", dial.least}, {"most", dial.most}, {"unit", dial.unit}};
}

Json switch_json(const Switch& one) {
  Json json{{"name", one.name},
            {"says", one.sentence},
            {"law", one.law},
            {"size", dial_json(one.size)},
            {"plain_sizes", one.plain_sizes()}};
  if (one.has_shape()) json["shape"] = dial_json(one.shape);
  return json;
}

std::string data_of(const plant::Rig& rig, const Session& session) {
  Json data{{"rig", report::drawn_rig_json(rig, rig.sensors.of(plant::Sensed::muscle_pressure) != nullptr)},
            {"tick_s", rig.tick_s},
            {"dac", {{"lowest", rig.dac.lowest_command}, {"largest", rig.dac.largest_command}}},
            {"signals", signals_json(rig)},
            {"switches", Json::array()}};
  if (!session.pair()) {
    data["load_kg"] = session.load_kg();
    data["loads"] = {{"least_kg", session.loads().least_kg}, {"most_kg", session.loads().most_kg}};
  }
  for (const Switch& one : session.switches().all()) data["switches"].push_back(switch_json(one));
  return report::in_script(data);
}

/// A slider and a number for the command of a muscle, which is named if there are two.
std::string command_row(int muscle, bool named) {
  return fmt::format(
      "<div class='line'>{1}<input id='current-{0}' type='range' step='0.01' aria-label='Current{2} in mA'>\n"
      "<input id='current-{0}-number' type='number' step='0.1' aria-label='Current{2} in mA, as a number'> "
      "mA</div>\n",
      muscle, named ? fmt::format("<span>muscle {}</span> ", muscle) : "",
      named ? fmt::format(" of muscle {}", muscle) : "");
}

constexpr const char* sweeps = R"html(<div class='line' role='group' aria-label='Sweeps'>
<button type='button' data-sweep='' aria-pressed='true'>by hand</button>
<button type='button' data-sweep='sine' aria-pressed='false'>sine</button>
<button type='button' data-sweep='triangle' aria-pressed='false'>triangle</button>
<button type='button' data-sweep='stairs' aria-pressed='false'>stairs</button></div>
<div class='line'>from <input id='low' type='number' step='0.5' aria-label='Lowest current of sweeps in mA'>
to <input id='high' type='number' step='0.5' aria-label='Highest current of sweeps in mA'> mA
in <input id='period' type='number' step='1' min='0.1' max='1000' aria-label='Period of sweeps in s'> s</div>
)html";

constexpr const char* load = R"html(<fieldset><legend>Load</legend>
<div class='line'><input id='load' type='range' step='any' aria-label='Load in kg'>
<input id='load-number' type='number' step='0.1' aria-label='Load in kg, as a number'> kg</div>
</fieldset>
)html";

std::string panel_of(const Session& session) {
  std::string panel = "<fieldset><legend>Current</legend>\n";
  if (session.pair())
    panel += command_row(1, true) + command_row(2, true) + sweeps +
             "<p class='small'>Sweeps: muscle 2 goes against muscle 1.</p>\n</fieldset>\n";
  else
    panel += command_row(1, false) + sweeps + "</fieldset>\n";
  panel = in_unit(session.rig().command_unit(), panel);  // with its ids, as the script has them
  return panel + (session.pair() ? "" : load) + std::string(time_html);
}

}  // namespace

Page page_of(const std::string& name, const plant::Rig& rig, const Session& session) {
  Page page;
  page.html = fmt::format(
      "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n"
      "<meta name='viewport' content='width=device-width,initial-scale=1'>\n<title>{0}, live</title>\n"
      "<link rel='icon' href='data:,'>\n<link rel='stylesheet' href='page.css'>\n</head>\n<body "
      "class='live-page'>\n"
      "<header>\n<h1>{0}, live</h1>\n{1}</header>\n<noscript><p class='warning'>This page needs its "
      "script.</p></noscript>\n"
      "<div id='alarm' class='warning' role='alert' hidden><p id='alarm-text'></p>\n"
      "<button id='alarm-again' type='button'>Begin again</button></div>\n"
      "<div class='bench'>\n<div class='panel'>\n{2}</div>\n{3}</div>\n"
      "<p class='small'>mckibben {4}. This page is made on your machine, for this machine alone, and loads "
      "nothing from elsewhere. Space: pause.</p>\n"
      "<details class='small'><summary>Licence of uPlot, which draws the "
      "plots</summary><pre>{5}</pre></details>\n"
      "<script type='application/json' id='data'>{6}</script>\n<script "
      "src='page.js'></script>\n</body>\n</html>\n",
      escaped(name), session.pair() ? "" : report::unit_switch, panel_of(session), stage_html,
      MCKIBBEN_VERSION, escaped(report::uplot_licence), data_of(rig, session));
  for (const auto& part : {report::uplot_css, report::picture_css, report::page_css, live_css})
    page.css += part;
  page.js = std::string(report::uplot_js) + "\n'use strict';\n";
  for (const auto& part : {report::data_js, report::plots_js, report::rig_js, report::pair_js,
                           report::lever_js, scroll_js, panel_js, live_js})
    page.js += part;
  return page;
}

}  // namespace mckibben::live
