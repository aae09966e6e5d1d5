// The report of `dataset`: what was measured, load by load. Nothing that only the simulation knows.
#include <algorithm>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/output/table.hpp>
#include <sim/report/by_load.hpp>
#include <sim/report/html.hpp>
#include <sim/report/length.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/report.hpp>

namespace mckibben::report {
namespace {

struct Counted {
  std::size_t runs = 0, rows = 0;
  double largest = 0.0;
};

Run shown(const domain::Run& measured, std::size_t style, const plant::Plant& plant) {
  Run run{.name = measured.id, .style = style, .ticks = measured.current_mA.size()};
  run.quantities = {{"contraction", [&measured](std::size_t k) { return measured.contraction_ratio[k]; }},
                    {"current", [&measured](std::size_t k) { return measured.current_mA[k]; }},
                    {"reference_pressure", [&measured, plant](std::size_t k) {
                       return plant.reference_pressure_Pa(measured.current_mA[k]) / 1e5;
                     }}};
  if (measured.muscle_pressure_Pa)
    run.quantities.push_back(
        {"muscle_pressure", [&measured](std::size_t k) { return (*measured.muscle_pressure_Pa)[k] / 1e5; }});
  return run;
}

}  // namespace

std::string report_html(const domain::Campaign& campaign, const input::Json& document,
                        const domain::Dataset& dataset) {
  Contents contents{
      .title = campaign.name,
      .about = "Synthetic measurements: what encoder, current output and gauge say",
      .details = output::table_of(campaign, document),
      .beside =
          "Every number of every tick is in the CSV files beside this page; input, versions and "
          "hashes are in campaign.json, the truth in a folder of its own.",
      .rig = dataset.rig,
      .gauge = dataset.rig.gauge.fitted,
      .plots = measured_plots(),
      .loops = measured_loops()};
  std::string rows;
  Counted all;
  for (const double load_kg : campaign.loads_kg) {
    const plant::Plant plant(dataset.rig, load_kg);
    Group group{.name = domain::write_number(load_kg) + " kg", .load_kg = load_kg};
    Counted load;
    for (const domain::Run& measured : dataset.runs) {
      if (measured.load_kg != load_kg) continue;
      group.ticks = std::max(group.ticks, measured.current_mA.size());
      group.runs.push_back(shown(measured, load.runs, plant));
      ++load.runs;
      load.rows += measured.current_mA.size();
      load.largest = std::max(load.largest, *std::max_element(measured.contraction_ratio.begin(),
                                                              measured.contraction_ratio.end()));
    }
    const bool any = !group.runs.empty();
    const std::size_t place = contents.groups.size();
    rows += fmt::format(
        "<tr{}><th scope='row'>{}</th><td>{}</td><td>{}</td><td>{:.1f}</td><td>{}</td></tr>\n",
        any ? fmt::format(" data-group='{}'", place) : "", any ? link_html(place, group.name) : group.name,
        load.runs, load.rows, static_cast<double>(load.rows) * dataset.rig.tick_s,
        length_html(load.largest, dataset.rig, 2));
    all.runs += load.runs;
    all.rows += load.rows;
    all.largest = std::max(all.largest, load.largest);
    if (any) contents.groups.push_back(std::move(group));
  }
  contents.sentence = fmt::format(
      "{} run{} with {} load{} and {} current{}, {:.1f} minutes in all; the muscle shortens by up to {}.",
      all.runs, all.runs == 1 ? "" : "s", campaign.loads_kg.size(), campaign.loads_kg.size() == 1 ? "" : "s",
      campaign.currents.size(), campaign.currents.size() == 1 ? "" : "s",
      static_cast<double>(all.rows) * dataset.rig.tick_s / 60.0,
      full_length_html(all.largest, dataset.rig, 1));
  contents.table =
      "<table><caption>What was measured</caption>\n<thead><tr><th scope='col'>load</th><th "
      "scope='col'>runs</th><th scope='col'>rows</th><th scope='col'>seconds</th><th "
      "scope='col'>largest contraction, " +
      length_unit_html() + "</th></tr></thead>\n<tbody>\n" + rows + "</tbody></table>\n";
  return html_of(contents);
}

}  // namespace mckibben::report
