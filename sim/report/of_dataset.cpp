// The report of `dataset`: what was measured, load by load; of a pair, current by current. Nothing that only
// the simulation knows.
#include <algorithm>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/output/run_results.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/html.hpp>
#include <sim/report/length.hpp>
#include <sim/report/quantities.hpp>
#include <sim/report/report.hpp>
#include <sim/report/tables.hpp>

namespace mckibben::report {
namespace {

struct Counted {
  std::size_t runs = 0, rows = 0;
  double largest = 0.0;
};

Run shown(const domain::Run& measured, std::size_t style, const plant::Plant& plant) {
  Run run{.name = measured.id, .style = style, .ticks = measured.current_mA.size()};
  run.quantities = {
      {"contraction_ratio", [&measured](std::size_t k) { return measured.contraction_ratio[k]; }},
      {"current", [&measured](std::size_t k) { return measured.current_mA[k]; }},
      {"reference_pressure", [&measured, plant](std::size_t k) {
         return plant.reference_pressure_Pa(measured.current_mA[k]) / 1e5;
       }}};
  if (measured.muscle_pressure_Pa)
    run.quantities.push_back(
        {"muscle_pressure", [&measured](std::size_t k) { return (*measured.muscle_pressure_Pa)[k] / 1e5; }});
  return run;
}

/// What there is to say of the runs of a load, or of a current of a pair: a row of the table, and a group if
/// there are any. The cells of the row are those after its head.
void add(Contents& contents, std::string& rows, Group group, const std::string& cells) {
  const bool any = !group.runs.empty();
  const std::size_t place = contents.groups.size();
  rows +=
      fmt::format("<tr{}><th scope='row'>{}</th>{}</tr>\n", any ? fmt::format(" data-group='{}'", place) : "",
                  any ? link_html(place, group.name) : output::escaped(group.name), cells);
  if (any) contents.groups.push_back(std::move(group));
}

std::string table_html(const std::string& group, const std::string& last, const std::string& rows) {
  return fmt::format(
      "<table><caption>What was measured</caption>\n<thead><tr><th scope='col'>{}</th><th "
      "scope='col'>runs</th><th scope='col'>rows</th><th scope='col'>seconds</th><th "
      "scope='col'>{}</th></tr></thead>\n<tbody>\n{}</tbody></table>\n",
      group, last, rows);
}

std::string plural(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void add_loads(Contents& contents, const domain::Campaign& campaign, const domain::Dataset& dataset) {
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
    add(contents, rows, std::move(group),
        fmt::format("<td>{}</td><td>{}</td><td>{:.1f}</td><td>{}</td>", load.runs, load.rows,
                    static_cast<double>(load.rows) * dataset.rig.tick_s,
                    length_html(load.largest, dataset.rig, 2)));
    all.runs += load.runs;
    all.rows += load.rows;
    all.largest = std::max(all.largest, load.largest);
  }
  contents.sentence = fmt::format(
      "{} with {} and {}, {:.1f} minutes in all; the muscle shortens by up to {}.", plural(all.runs, "run"),
      plural(campaign.loads_kg.size(), "load"), plural(campaign.currents.size(), "current"),
      static_cast<double>(all.rows) * dataset.rig.tick_s / 60.0,
      full_length_html(all.largest, dataset.rig, 1));
  contents.table = table_html("load", "largest contraction, " + length_unit_html(), rows);
}

/// Of a pair: its two currents, the pressures that they ask for, the angle and what follows from it.
Run shown_of_pair(const domain::Run& measured, std::size_t style, const plant::Rig& rig) {
  const plant::Pair& pair = *rig.pair();
  const plant::Plant plant = plant::plant_of(rig);
  const auto current_mA = [&measured](std::size_t muscle) {
    return &measured.measured->given("command", muscle);
  };
  const double radius_m = rig.joint.wheel_radius_m;
  const auto contraction = [&measured](double mounted, double per_rad) {
    return [&measured, mounted, per_rad](std::size_t k) { return mounted + per_rad * measured.angle_rad[k]; };
  };
  Run run{.name = measured.id, .style = style, .ticks = measured.angle_rad.size()};
  run.quantities = {
      {"angle", [&measured](std::size_t k) { return in_degrees * measured.angle_rad[k]; }},
      {"contraction_ratio_1", contraction(pair.contraction_ratio, radius_m / rig.muscle.rest_length_m)},
      {"contraction_ratio_2",
       contraction(pair.opposite_contraction_ratio, -radius_m / pair.opposite.muscle.rest_length_m)},
      {"current_1", [mA = current_mA(1)](std::size_t k) { return (*mA)[k]; }},
      {"current_2", [mA = current_mA(2)](std::size_t k) { return (*mA)[k]; }},
      {"reference_pressure_1",
       [mA = current_mA(1), plant](std::size_t k) {
         return plant.reference_pressure_Pa((*mA)[k]) / plant::Pa_per_bar;
       }},
      {"reference_pressure_2", [mA = current_mA(2), plant](std::size_t k) {
         return plant.opposite()->reference_pressure_Pa((*mA)[k]) / plant::Pa_per_bar;
       }}};
  const auto gauge = [&run](const char* key, const std::optional<std::vector<double>>& read) {
    if (read)
      run.quantities.push_back({key, [&read](std::size_t k) { return (*read)[k] / plant::Pa_per_bar; }});
  };
  gauge("muscle_pressure_1", measured.muscle_pressure_Pa);
  gauge("muscle_pressure_2", measured.opposite_pressure_Pa);
  return run;
}

void add_currents(Contents& contents, const domain::Campaign& campaign,
                  const std::vector<run::EndedRun>& ended, const domain::Dataset& dataset) {
  std::string rows;
  Counted all;
  double lowest_deg = 0.0, highest_deg = 0.0;
  for (std::size_t i = 0; i < campaign.currents.size(); ++i) {
    Group group{.name = campaign.currents[i].name};
    Counted current;
    run::Span angle_rad{};
    for (const run::EndedRun& run : ended) {
      if (run.job.current != i || !run.failure.empty()) continue;
      const auto& measured = *std::ranges::find(dataset.runs, run.job.id, &domain::Run::id);
      group.ticks = std::max(group.ticks, measured.angle_rad.size());
      group.runs.push_back(shown_of_pair(measured, current.runs, dataset.rig));
      angle_rad = {std::min(angle_rad.low, run.angle_rad.low), std::max(angle_rad.high, run.angle_rad.high)};
      ++current.runs;
      current.rows += run.rows;
    }
    add(contents, rows, std::move(group),
        fmt::format("<td>{}</td><td>{}</td><td>{:.1f}</td><td>{:+.1f} to {:+.1f}</td>", current.runs,
                    current.rows, static_cast<double>(current.rows) * dataset.rig.tick_s,
                    in_degrees * angle_rad.low, in_degrees * angle_rad.high));
    all.runs += current.runs;
    all.rows += current.rows;
    lowest_deg = std::min(lowest_deg, in_degrees * angle_rad.low);
    highest_deg = std::max(highest_deg, in_degrees * angle_rad.high);
  }
  contents.sentence = fmt::format(
      "{} of two muscles under {} of currents, {:.1f} minutes in all; the joint turns between {:.1f}° and "
      "{:.1f}°.",
      plural(all.runs, "run"), plural(campaign.currents.size(), "pair"),
      static_cast<double>(all.rows) * dataset.rig.tick_s / 60.0, lowest_deg, highest_deg);
  contents.table = table_html("currents", "joint angle, deg", rows);
}

}  // namespace

std::string report_html(const domain::Campaign& campaign, const std::vector<run::EndedRun>& ended,
                        const domain::Dataset& dataset) {
  const bool pair = dataset.rig.pair() != nullptr;
  Contents contents{
      .title = campaign.name,
      .about = "Synthetic measurements: what encoder, current output and gauge say",
      .warnings = run::warnings_of(ended),
      .details = output::table_of(campaign, ended),
      .beside =
          "Every number of every tick is in the CSV files beside this page; input, versions and "
          "hashes are in campaign.json, the truth in a folder of its own.",
      .lengths = !pair,
      .rig = dataset.rig,
      .mechanics = dataset.rig.mechanics,
      .gauge = dataset.rig.sensors.of(plant::Sensed::muscle_pressure) != nullptr,
      .plots = measured_plots(pair),
      .loops = measured_loops(pair)};
  if (pair)
    add_currents(contents, campaign, ended, dataset);
  else
    add_loads(contents, campaign, dataset);
  return html_of(contents);
}

}  // namespace mckibben::report
