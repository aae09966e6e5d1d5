// The report of `map`: rms errors by load and direction, and the maps.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/output/error_map.hpp>
#include <sim/report/html.hpp>
#include <sim/report/length.hpp>
#include <sim/report/report.hpp>

namespace mckibben::report {
namespace {

/// Sum of the squares of some maps' errors, and of how many targets.
struct Sum {
  double squares = 0.0;
  std::size_t cells = 0;

  void add(const run::MapError& error) {
    squares += error.ratio * error.ratio * static_cast<double>(error.cells);
    cells += error.cells;
  }
  double rms() const { return std::sqrt(squares / static_cast<double>(cells)); }
  std::string cell(const plant::Rig& rig) const { return cells == 0 ? "-" : length_html(rms(), rig, 1); }
};

}  // namespace

std::string report_html(const run::MapPlan& plan, const run::ErrorMaps& maps) {
  Contents contents{.title = "Errors of the thesis's controller",
                    .about = fmt::format("{} loads, {} contraction ratios x {} speeds, a run for each",
                                         maps.loads.size(), plan.ratios.size(), plan.speeds_per_s.size()),
                    .details = output::table_of(plan, maps),
                    .beside = "Every target is in map.csv, limits and inputs are in map.json."};
  std::vector<Picture> pictures;
  std::string& html = contents.table;
  html = fmt::format(
      "<table><caption>Root mean square error of height at the time of arrival; reachable: what the rig can "
      "pass at that speed</caption>\n<thead><tr><th scope='col'>load</th><th scope='col'>direction</th><th "
      "scope='col'>weighed, kg</th><th scope='col'>reachable</th><th scope='col'>error there, {0}</th><th "
      "scope='col'>error beyond, {0}</th></tr></thead>\n<tbody>\n",
      length_unit_html());
  Sum all_within, all_beyond;
  for (const auto& load : maps.loads) {
    if (!load.failure.empty()) {
      html += fmt::format("<tr><th scope='row'>{:g} kg</th><td colspan='5'>no map</td></tr>\n", load.load_kg);
      continue;
    }
    for (const auto& map : load.branches) {
      Sum within, beyond;
      const auto reachable = [](const run::MapCell& cell) { return cell.reachable; };
      for (Sum* sum : {&within, &all_within}) sum->add(error_over(map, reachable));
      for (Sum* sum : {&beyond, &all_beyond}) sum->add(error_over(map, std::not_fn(reachable)));
      const auto share = static_cast<double>(std::count_if(map.cells.begin(), map.cells.end(), reachable)) /
                         static_cast<double>(map.cells.size());
      html += fmt::format(
          "<tr><th scope='row'>{:g} kg</th><td>{}</td><td>{:.3f}</td><td>{:.0f} %</td><td>{}</td>"
          "<td>{}</td></tr>\n",
          load.load_kg, map.branch == controllers::Branch::contraction ? "up" : "down", load.weighed_kg,
          100.0 * share, within.cell(plan.rig), beyond.cell(plan.rig));
    }
    pictures.push_back(
        {fmt::format(
             "{:g} kg. White is right, orange too high or too fast, blue too low or too slow; inside the "
             "line is what the rig can reach.",
             load.load_kg),
         either(output::heat_map_svg(plan, maps, load, output::MapUnit::mm),
                output::heat_map_svg(plan, maps, load), "div")});
  }
  html += "</tbody></table>\n";
  if (!pictures.empty()) contents.chapters = {{"Figures", figures_html(pictures, true)}};
  contents.sentence =
      all_within.cells == 0
          ? "No target that the rig can reach was run."
          : fmt::format("Where the rig can go, the load arrives {} off, root mean square over {} targets{}.",
                        full_length_html(all_within.rms(), plan.rig, 1), all_within.cells,
                        all_beyond.cells == 0
                            ? ""
                            : "; beyond, " + full_length_html(all_beyond.rms(), plan.rig, 1) + " off");
  return html_of(contents);
}

}  // namespace mckibben::report
