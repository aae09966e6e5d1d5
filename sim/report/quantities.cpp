// Plots and loops; see the header.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/report/length.hpp>
#include <sim/report/quantities.hpp>

namespace mckibben::report {
namespace {

constexpr double least_normal_N = 50.0;      // below it a coefficient is a quotient of small numbers
constexpr double least_speed_per_s = 0.002;  // below it threads may stick, with any friction up to the level

/// Where the joint is: what a page is about, unless it is about a force.
const char* position(bool pair) {
  return pair ? "angle" : "contraction_ratio";
}

/// The lines of a signal: one, or of two muscles one each, called `label N`.
std::vector<Line> lines_of(bool pair, const std::string& key, const std::string& label, bool main = true,
                           const std::string& each = "muscle") {
  if (!pair) return {{.key = key, .label = label, .main = main}};
  return {{.key = key + "_1", .label = each + " 1", .main = main},
          {.key = key + "_2", .label = each + " 2", .main = main}};
}

std::string unit_of(std::string_view key) {
  return std::string(plant::Channel{&plant::signal_of(key)}.page_unit());
}

Plot plot_of(std::string id, std::string title, std::string_view key, std::vector<Line> lines) {
  return {.id = std::move(id), .title = std::move(title), .unit = unit_of(key), .lines = std::move(lines)};
}

Plot commands_of(const plant::Rig& rig, bool pair) {
  const plant::Signal& command = plant::command_of(rig.command_unit());
  const std::string key(command.key);
  return {.id = key,
          .title = in_unit(rig.command_unit(), pair ? "Currents" : "Current"),
          .unit = std::string(command.unit.name),
          .lines = lines_of(pair, key, key)};
}

Plot error_of(const std::string& id, std::string title, std::string_view key) {
  return plot_of(id, std::move(title), key, {{.key = id, .label = "error", .main = true}});
}

/// Lines of what was read, of each muscle of a pair; what was not read is not drawn.
void add_measured(Plot& plot, const std::string& key, bool pair, const std::string& label,
                  const std::string& each) {
  for (Line& line : lines_of(pair, "given_" + key, label, false, each)) {
    line.given = true;
    plot.lines.push_back(std::move(line));
  }
}

Plot pressures_of(const plant::Rig& rig, const PlotsOf& of) {
  const bool pair = of.driven.pair;
  Plot plot =
      plot_of("pressures", "Pressures", "muscle_pressure", lines_of(pair, "muscle_pressure", "muscle"));
  const auto add = [&](std::vector<Line> lines) {
    plot.lines.insert(plot.lines.end(), lines.begin(), lines.end());
  };
  if (of.valve_pressure || (!pair && (of.commands || of.driven.pressure[0] == plant::GivenPressure::valve)))
    add(lines_of(pair, "valve_pressure", "valve", false, "valve of muscle"));
  if (!pair && of.commands && asks_for_pressure(rig))
    add({{.key = "reference_pressure", .label = "commanded"}});
  if (pair || of.pressure) add_measured(plot, "muscle_pressure", pair, "measured", "measured, muscle");
  if (of.valve_pressure)
    add_measured(plot, "valve_pressure", pair, "measured, valve", "measured, valve of muscle");
  return plot;
}

Loop pressure_loop(const std::string& muscle) {
  return {"pressure_" + muscle,
          "Pressure and contraction of muscle " + muscle,
          "contraction_ratio_" + muscle,
          "muscle_pressure_" + muscle,
          "contraction ratio of muscle " + muscle,
          "pressure of muscle " + muscle + " in bar"};
}

Loop pressure_loop() {
  return {"pressure",
          "Pressure and contraction",
          "contraction_ratio",
          "muscle_pressure",
          std::string(ratio_unit),
          "muscle pressure in bar",
          false,
          "given_contraction_ratio",
          "given_muscle_pressure"};
}

}  // namespace

LoopOver loop_over(const plant::Rig& rig, bool gauged, const std::string& of_muscle) {
  const std::string of = of_muscle.empty() ? "" : "_" + of_muscle, space = of_muscle.empty() ? "" : " ";
  const auto over = [&](const std::string& key, const std::string& words, std::string_view unit) {
    const std::string whole = words + space + of_muscle;
    return LoopOver{key + of, whole, fmt::format("{} in {}", whole, unit)};
  };
  if (asks_for_pressure(rig)) return over("reference_pressure", "commanded pressure", "bar");
  if (gauged) return over("given_muscle_pressure", "measured muscle pressure", "bar");
  const std::string key = plant::command_key(rig);
  return over(key, key, name_of(rig.command_unit()));
}

std::vector<Quantity> quantities_of(const run::Recording& recording, const plant::Rig& rig) {
  const auto* rows = &recording.samples;
  std::vector<Quantity> all;
  for (const plant::Channel& channel : plant::channels_of(rig, recording.driven))
    all.push_back({channel.key(), [rows, channel](std::size_t k) { return channel.on_page((*rows)[k]); }});
  if (recording.driven.pair) return all;
  const plant::Muscle& muscle = rig.muscle;
  all.push_back({"friction_coefficient", [rows, braid = plant::Braid(muscle), rigid = muscle.cord.absent(),
                                          length_m = muscle.rest_length_m](std::size_t k) {
                   const run::Sample& row = (*rows)[k];
                   const double normal_N = braid.contact_surface_m2(row.contraction_ratio) *
                                           row.state.side.muscle_pressure_Pa;  // T 4.2
                   const double speed_per_s =
                       rigid ? row.state.joint.contraction_speed_per_s : row.cord_end_m_per_s / length_m;
                   const bool slides = std::abs(speed_per_s) > least_speed_per_s;
                   return !slides || normal_N < least_normal_N ? std::numeric_limits<double>::quiet_NaN()
                                                               : std::abs(row.friction_force_N) / normal_N;
                 }});
  return all;
}

std::vector<Plot> plots_of(const plant::Rig& rig, const PlotsOf& of) {
  const bool pair = of.driven.pair, about_force = of.key == "force",
             about_pressure = of.key == "muscle_pressure";
  const std::string at = position(pair);
  const char* label = of.key == "angle" ? "angle"
                      : about_force     ? "force"
                      : about_pressure  ? "pressure"
                                        : "contraction";
  Plot first = plot_of(about_force || about_pressure ? label
                       : of.key == "angle"           ? "angle"
                                                     : "height",
                       of.title, of.key, {});
  if (!of.given.empty()) first.lines.push_back({.key = "given_" + of.key, .label = of.given, .given = true});
  first.lines.push_back({.key = of.key, .label = label, .main = true});
  first.still = true;
  std::vector<Plot> plots{std::move(first)};
  if (!of.error.empty()) plots.push_back(error_of("error", of.error, of.key));
  if (about_force || (about_pressure && !pair))
    plots.push_back(plot_of("height", about_force ? "Contraction, as given" : "Contraction", at,
                            lines_of(false, at, "contraction")));
  if (!pair && of.force) {
    plots.push_back(plot_of("force", "Force of the cord", "force",
                            {{.key = "given_force", .label = "measured", .given = true},
                             {.key = "force", .label = "cord", .main = true}}));
    plots.push_back(error_of("force_error", "Force of the cord: " + of.off, "force"));
  }
  if (of.commands) plots.push_back(commands_of(rig, pair));
  plots.push_back(pressures_of(rig, of));
  if (!pair && of.pressure)
    plots.push_back(error_of("muscle_pressure_error", "Error of the pressure: " + of.off, "muscle_pressure"));
  if (!pair && of.valve_pressure)
    plots.push_back(
        error_of("valve_pressure_error", "Error of the valve's pressure: " + of.off, "valve_pressure"));
  if (of.driven.joint_force)
    plots.push_back(pair || rig.has_angle()
                        ? plot_of("joint_torque", "Torque on the joint from outside", "joint_torque",
                                  {{.key = "joint_torque", .label = "torque"}})
                        : plot_of("joint_force", "Force on the cord from outside", "joint_force",
                                  {{.key = "joint_force", .label = "force"}}));
  if (pair) {
    plots.push_back(plot_of("tensions", "Forces of the cords", "force", lines_of(true, "tension", "")));
    add_measured(plots.back(), "tension", pair, "measured", "measured, cord");
    plots.push_back(plot_of("stiffness", "Stiffness of the joint", "stiffness",
                            {{.key = "given_stiffness", .label = "target", .given = true},
                             {.key = "stiffness", .label = "stiffness", .main = true}}));
    plots.push_back(plot_of("ratios", "Contraction ratios of the muscles", "contraction_ratio",
                            lines_of(true, "contraction_ratio", "")));
    plots.back().unit = "ratio";  // lengths of two muscles have no common mm
    return plots;
  }
  Plot forces = plot_of(
      "forces",
      of.driven.length || rig.has_angle() ? "Forces that shorten the muscle" : "Forces on the load, upwards",
      "force",
      {{.key = "braid_force", .label = "braid", .main = true},
       {.key = "friction_force", .label = "friction of the threads"}});
  if (!rig.has_angle())
    forces.lines.push_back({.key = "weight", .label = "weight of the load, downwards", .given = true});
  if (!rig.effects.absent()) forces.lines.push_back({.key = "effects_pull", .label = "effects of the rig"});
  if (of.driven.length || of.force) forces.lines.push_back({.key = "force", .label = "all: the cord"});
  plots.push_back(std::move(forces));
  return plots;
}

std::vector<Loop> loops_of(const plant::Rig& rig, const run::Driven& driven) {
  const std::string ratio(ratio_unit), angle = "joint angle in deg";
  const std::string of_muscle = rig.muscle.cord.absent() ? "contraction_ratio" : "muscle_contraction_ratio";
  if (driven.pair)
    return {{"torque", "Joint angle and torque of both muscles", "angle", "torque", angle, "torque in N m"},
            {"tension_1", "Joint angle and force of cord 1", "angle", "tension_1", angle, "force in N"},
            {"tension_2", "Joint angle and force of cord 2", "angle", "tension_2", angle, "force in N"},
            pressure_loop("1"),
            pressure_loop("2")};
  if (driven.length || driven.force)
    return {{"force", "Force of the cord and contraction", "contraction_ratio", "force", ratio, "force in N"},
            pressure_loop()};
  return {pressure_loop(),
          {"force", "Braid force and contraction", of_muscle, "braid_force", ratio, "braid force in N"},
          {"friction",
           "Friction coefficient and contraction: friction of the threads for "
           "each newton of normal force, while they slide",
           of_muscle, "friction_coefficient", ratio, "friction coefficient", true}};
}

std::vector<Plot> measured_plots(const plant::Rig& rig, bool pair) {
  const bool angle = rig.has_angle();
  const std::string at = position(angle);
  std::vector<Plot> plots{
      plot_of(angle ? "angle" : "height", angle ? "Joint angle, as counted" : "Contraction, as counted", at,
              lines_of(false, at, angle ? "angle" : "contraction")),
      commands_of(rig, pair),
      plot_of("pressures", "Pressures", "muscle_pressure",
              lines_of(pair, "reference_pressure", "commanded", true, "commanded"))};
  plots.front().still = true;
  if (!asks_for_pressure(rig)) plots.back().lines.clear();
  for (Line& line : lines_of(pair, "muscle_pressure", "gauge on the muscle", false, "gauge on muscle"))
    plots.back().lines.push_back(std::move(line));
  return plots;
}

std::vector<Loop> measured_loops(const plant::Rig& rig, bool gauged) {
  const bool pair = rig.pair() != nullptr;
  const auto driven = [&](const std::string& id, const std::string& muscle) {
    const LoopOver over = loop_over(rig, false, muscle);
    return Loop{id,         (pair ? "Joint angle and " : "Contraction and ") + over.words,
                over.key,   pair ? "angle" : "contraction_ratio",
                over.label, pair ? "joint angle in deg" : std::string(ratio_unit)};
  };
  if (pair)
    return {driven("reference_1", "1"), driven("reference_2", "2"), pressure_loop("1"), pressure_loop("2")};
  if (gauged && !asks_for_pressure(rig)) return {pressure_loop()};
  return {driven("current", ""), pressure_loop()};
}

}  // namespace mckibben::report
