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

/// Muscle pressures as they were read.
void add_gauges(Run& run, const domain::Run& measured) {
  for (const domain::Reading& read : measured.readings)
    if (read.channel.signal->key == "muscle_pressure")
      run.quantities.push_back(
          {read.channel.key(), [&read](std::size_t k) { return read.values[k] / plant::Pa_per_bar; }});
}

/// Of a load, or of a lever with the contraction that its angle means.
Run shown(const domain::Run& measured, std::size_t style, const plant::Plant& plant) {
  const bool angle = plant.rig().has_angle();
  const std::vector<double>& commands = angle ? measured.measured->given("command") : measured.current_mA;
  Run run{.name = measured.id, .style = style, .ticks = measured.rows()};
  if (angle)
    run.quantities.push_back(
        {"angle", [&measured](std::size_t k) { return in_degrees * measured.judged().values[k]; }});
  run.quantities.push_back({"contraction_ratio", [&measured, plant, angle](std::size_t k) {
                              const double read = measured.judged().values[k];
                              return angle ? plant.ratio_at_rad(read) : read;
                            }});
  run.quantities.push_back(
      {plant::command_key(plant.rig()), [&commands](std::size_t k) { return commands[k]; }});
  run.quantities.push_back({"reference_pressure", [&commands, plant](std::size_t k) {
                              return plant.reference_pressure_Pa(commands[k]) / plant::Pa_per_bar;
                            }});
  add_gauges(run, measured);
  return run;
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
    return [&measured, mounted, per_rad](std::size_t k) {
      return mounted + per_rad * measured.judged().values[k];
    };
  };
  Run run{.name = measured.id, .style = style, .ticks = measured.rows()};
  run.quantities = {
      {"angle", [&measured](std::size_t k) { return in_degrees * measured.judged().values[k]; }},
      {"contraction_ratio_1", contraction(pair.contraction_ratio, radius_m / rig.muscle.rest_length_m)},
      {"contraction_ratio_2",
       contraction(pair.opposite_contraction_ratio, -radius_m / pair.opposite.muscle.rest_length_m)},
      {plant::command_key(rig) + "_1", [commands = current_mA(1)](std::size_t k) { return (*commands)[k]; }},
      {plant::command_key(rig) + "_2", [commands = current_mA(2)](std::size_t k) { return (*commands)[k]; }},
      {"reference_pressure_1",
       [mA = current_mA(1), plant](std::size_t k) {
         return plant.reference_pressure_Pa((*mA)[k]) / plant::Pa_per_bar;
       }},
      {"reference_pressure_2", [mA = current_mA(2), plant](std::size_t k) {
         return plant.opposite()->reference_pressure_Pa((*mA)[k]) / plant::Pa_per_bar;
       }}};
  add_gauges(run, measured);
  return run;
}

/// What is shown of a run of a group, without pressures that are not asked for.
Run asked_for(Run run, const plant::Rig& rig) {
  if (!asks_for_pressure(rig))
    std::erase_if(run.quantities,
                  [](const Quantity& one) { return one.key.starts_with("reference_pressure"); });
  return run;
}

/// What runs that belong together come to, and how far: a contraction ratio, or angles of a pair.
struct Counted {
  std::size_t runs = 0, rows = 0;
  run::Span span{};

  void add(const Counted& other) {
    runs += other.runs;
    rows += other.rows;
    span = {std::min(span.low, other.span.low), std::max(span.high, other.span.high)};
  }
};

/// A row of the table, and a group if there are runs, of each load; of a pair, of each current.
void add_parts(Contents& contents, const domain::Campaign& campaign, const std::vector<run::EndedRun>& ended,
               const domain::Dataset& dataset) {
  const plant::Rig& rig = dataset.rig;
  const bool pair = rig.pair() != nullptr, angle = rig.has_angle();
  const auto seconds = [&](const Counted& of) { return static_cast<double>(of.rows) * rig.tick_s; };
  std::string rows;
  Counted all;
  const std::size_t parts = pair ? campaign.currents.size() : campaign.loads_kg.size();
  for (std::size_t i = 0; i < parts; ++i) {
    const double load_kg = pair ? 0.0 : campaign.loads_kg[i];
    Group group{.name = pair ? campaign.currents[i].name : domain::write_kg(load_kg) + " kg",
                .load_kg = load_kg};
    Counted part;
    for (const run::EndedRun& run : ended) {
      if (!run.failure.empty() || (pair ? run.job.current != i : run.job.load_kg != load_kg)) continue;
      const domain::Run& measured = *std::ranges::find(dataset.runs, run.job.id, &domain::Run::id);
      group.runs.push_back(asked_for(pair ? shown_of_pair(measured, part.runs, rig)
                                          : shown(measured, part.runs, plant::plant_of(rig, load_kg)),
                                     rig));
      group.ticks = std::max(group.ticks, group.runs.back().ticks);
      part.add({1, group.runs.back().ticks,
                angle ? run.angle_rad : run::Span{0.0, std::ranges::max(measured.judged().values)}});
    }
    const bool any = !group.runs.empty();
    const std::size_t place = contents.groups.size();
    rows += fmt::format(
        "<tr{}><th scope='row'>{}</th><td>{}</td><td>{}</td><td>{:.1f}</td><td>{}</td></tr>\n",
        any ? fmt::format(" data-group='{}'", place) : "",
        any ? link_html(place, group.name) : output::escaped(group.name), part.runs, part.rows, seconds(part),
        angle ? fmt::format("{:+.1f} to {:+.1f}", in_degrees * part.span.low, in_degrees * part.span.high)
              : length_html(part.span.high, rig, 2));
    if (any) contents.groups.push_back(std::move(group));
    all.add(part);
  }
  const auto plural = [](std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  const double minutes = seconds(all) / 60.0;
  contents.sentence =
      pair ? fmt::format(
                 "{} of two muscles under {} of currents, {:.1f} minutes in all; the joint turns between "
                 "{:.1f}° and {:.1f}°.",
                 plural(all.runs, "run"), plural(parts, "pair"), minutes, in_degrees * all.span.low,
                 in_degrees * all.span.high)
           : fmt::format("{} with {} and {}, {:.1f} minutes in all; the {} by up to {}.",
                         plural(all.runs, "run"), plural(parts, "load"),
                         plural(campaign.currents.size(), "current"), minutes,
                         angle ? "lever turns" : "muscle shortens",
                         angle ? fmt::format("{:.1f}°", in_degrees * all.span.high)
                               : full_length_html(all.span.high, rig, 1));
  contents.table = fmt::format(
      "<table><caption>What was measured</caption>\n<thead><tr><th scope='col'>{}</th><th "
      "scope='col'>runs</th><th scope='col'>rows</th><th scope='col'>seconds</th><th "
      "scope='col'>{}</th></tr></thead>\n<tbody>\n{}</tbody></table>\n",
      pair ? "currents" : "load", angle ? "joint angle, deg" : "largest contraction, " + length_unit_html(),
      rows);
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
          "Every number of every tick is in the CSV files of this folder; input and versions are in "
          "campaign.json, the truth and hashes in a folder of its own.",
      .handed_out = true,
      .lengths = !dataset.rig.has_angle(),
      .rig = dataset.rig,
      .gauge = dataset.rig.sensors.of(plant::Sensed::muscle_pressure) != nullptr,
      .plots = measured_plots(dataset.rig, pair),
      .loops = measured_loops(dataset.rig, std::ranges::any_of(dataset.runs, [](const domain::Run& run) {
                                return run.find("muscle_pressure") != nullptr;
                              }))};
  add_parts(contents, campaign, ended, dataset);
  return html_of(contents);
}

}  // namespace mckibben::report
