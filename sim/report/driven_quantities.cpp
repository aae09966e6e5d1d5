// Keys, units and labels; see the header.
#include <utility>

#include <sim/report/driven_quantities.hpp>
#include <sim/report/length.hpp>
#include <sim/run/gaps.hpp>

namespace mckibben::report {
namespace {

using run::Sample;

constexpr double in_bar = 1.0 / plant::Pa_per_bar;

/// Quantities of a recording, one by one.
class RowQuantities {
 public:
  explicit RowQuantities(const run::Recording& recording) : rows_(&recording.samples) {}
  template <class Value>
  void add(const char* key, const Value& value) {
    all.push_back({key, [rows = rows_, value](std::size_t k) { return value((*rows)[k]); }});
  }
  std::vector<Quantity> all;

 private:
  const std::vector<Sample>* rows_;
};

/// A plot of a quantity, and of its error, if something is drawn beside it: keys given_X, X, X_error.
void add_compared(std::vector<Plot>& plots, const std::string& key, const std::string& title,
                  const std::string& unit, const std::string& label, const Beside& beside) {
  Plot plot{.id = key, .title = title, .unit = unit, .lines = {}, .still = true};
  if (!beside.label.empty())
    plot.lines.push_back({.key = "given_" + key, .label = beside.label, .given = true});
  plot.lines.push_back({.key = key, .label = label, .main = true});
  plots.push_back(std::move(plot));
  if (!beside.label.empty())
    plots.push_back({key + "_error",
                     title + ": " + beside.error,
                     unit,
                     {{.key = key + "_error", .label = "error", .main = true}}});
}

Loop pressure_loop(const std::string& muscle) {
  return {"pressure_" + muscle,
          "Pressure and contraction of muscle " + muscle,
          "contraction_" + muscle,
          "muscle_pressure_" + muscle,
          "contraction ratio of muscle " + muscle,
          "pressure of muscle " + muscle + " in bar"};
}

Plot currents_plot() {
  return {"current",
          "Currents",
          "mA",
          {{.key = "current_1", .label = "muscle 1", .main = true},
           {.key = "current_2", .label = "muscle 2", .main = true}}};
}

}  // namespace

std::vector<Quantity> pair_quantities(const domain::RigFile& rig, const run::Recording& recording) {
  RowQuantities of(recording);
  const auto& given = recording.driven.pressure;
  of.add("angle", [&rig](const Sample& s) { return in_degrees * run::angle_rad(rig, s); });
  of.add("contraction_1", [](const Sample& s) { return s.state.joint.contraction_ratio; });
  of.add("contraction_2", [](const Sample& s) { return s.opposite.contraction_ratio; });
  if (!given[0]) of.add("current_1", [](const Sample& s) { return s.current_mA; });
  if (!given[1]) of.add("current_2", [](const Sample& s) { return s.opposite.current_mA; });
  if (!given[0])
    of.add("valve_pressure_1", [](const Sample& s) { return in_bar * s.state.side.valve_pressure_Pa; });
  if (!given[1])
    of.add("valve_pressure_2", [](const Sample& s) { return in_bar * s.state.opposite.valve_pressure_Pa; });
  of.add("muscle_pressure_1", [](const Sample& s) { return in_bar * s.state.side.muscle_pressure_Pa; });
  of.add("muscle_pressure_2", [](const Sample& s) { return in_bar * s.state.opposite.muscle_pressure_Pa; });
  of.add("tension_1", [](const Sample& s) { return s.cord_force_N; });
  of.add("tension_2", [](const Sample& s) { return s.opposite.cord_force_N; });
  of.add("torque", [radius_m = rig.joint.wheel_radius_m](const Sample& s) {
    return radius_m * (s.cord_force_N - s.opposite.cord_force_N);
  });
  of.add("stiffness", [](const Sample& s) { return s.stiffness_N_m_per_rad; });
  return std::move(of.all);
}

std::vector<Quantity> single_quantities(const run::Recording& recording) {
  RowQuantities of(recording);
  of.add("contraction", [](const Sample& s) { return s.state.joint.contraction_ratio; });
  if (!recording.driven.pressure[0]) {
    of.add("current", [](const Sample& s) { return s.current_mA; });
    of.add("valve_pressure", [](const Sample& s) { return in_bar * s.state.side.valve_pressure_Pa; });
  }
  of.add("muscle_pressure", [](const Sample& s) { return in_bar * s.state.side.muscle_pressure_Pa; });
  of.add("braid_force", [](const Sample& s) { return s.braid_force_N; });
  of.add("friction_force", [](const Sample& s) { return s.friction_force_N; });
  of.add("cord_force", [](const Sample& s) { return s.cord_force_N; });
  return std::move(of.all);
}

std::vector<Plot> pair_plots(const Beside& angle, bool commands) {
  std::vector<Plot> plots;
  add_compared(plots, "angle", "Joint angle", "deg", "angle", angle);
  if (commands) plots.push_back(currents_plot());
  plots.push_back({"pressures",
                   "Pressures",
                   "bar",
                   {{.key = "muscle_pressure_1", .label = "muscle 1", .main = true},
                    {.key = "muscle_pressure_2", .label = "muscle 2", .main = true},
                    {.key = "given_muscle_pressure_1", .label = "measured, muscle 1", .given = true},
                    {.key = "given_muscle_pressure_2", .label = "measured, muscle 2", .given = true}}});
  plots.push_back({"tensions",
                   "Forces of the cords",
                   "N",
                   {{.key = "tension_1", .label = "muscle 1", .main = true},
                    {.key = "tension_2", .label = "muscle 2", .main = true}}});
  plots.push_back({"stiffness",
                   "Stiffness of the joint",
                   "N m/rad",
                   {{.key = "given_stiffness", .label = "target", .given = true},
                    {.key = "stiffness", .label = "stiffness", .main = true}}});
  plots.push_back({"ratios",
                   "Contraction ratios of the muscles",
                   "ratio",
                   {{.key = "contraction_1", .label = "muscle 1", .main = true},
                    {.key = "contraction_2", .label = "muscle 2", .main = true}}});
  return plots;
}

std::vector<Plot> measured_pair_plots() {
  return {
      {"angle", "Joint angle, as counted", "deg", {{.key = "angle", .label = "angle", .main = true}}, true},
      currents_plot(),
      {"pressures",
       "Pressures",
       "bar",
       {{.key = "reference_pressure_1", .label = "asked of valve 1", .main = true},
        {.key = "reference_pressure_2", .label = "asked of valve 2", .main = true},
        {.key = "muscle_pressure_1", .label = "gauge on muscle 1"},
        {.key = "muscle_pressure_2", .label = "gauge on muscle 2"}}}};
}

std::vector<Loop> measured_pair_loops() {
  return {{"reference_1", "Joint angle and pressure asked of valve 1", "reference_pressure_1", "angle",
           "pressure asked of valve 1 in bar", "joint angle in deg"},
          {"reference_2", "Joint angle and pressure asked of valve 2", "reference_pressure_2", "angle",
           "pressure asked of valve 2 in bar", "joint angle in deg"},
          pressure_loop("1"),
          pressure_loop("2")};
}

std::vector<Plot> single_plots(const Measured& measured) {
  std::vector<Plot> plots;
  add_compared(plots, "contraction", "Contraction", std::string(ratio_unit), "contraction",
               measured.contraction ? measured_beside() : Beside{});
  if (measured.force) add_compared(plots, "cord_force", "Force of the cord", "N", "cord", measured_beside());
  if (measured.commands)
    plots.push_back({"current", "Current", "mA", {{.key = "current", .label = "current", .main = true}}});
  plots.push_back({"pressures",
                   "Pressures",
                   "bar",
                   {{.key = "muscle_pressure", .label = "muscle", .main = true},
                    {.key = "valve_pressure", .label = "valve"},
                    {.key = "given_muscle_pressure", .label = "measured", .given = true}}});
  if (measured.pressure)
    plots.push_back({"muscle_pressure_error",
                     "Error of the pressure: " + measured_beside().error,
                     "bar",
                     {{.key = "muscle_pressure_error", .label = "error", .main = true}}});
  plots.push_back({"forces",
                   "Forces that shorten the muscle",
                   "N",
                   {{.key = "braid_force", .label = "braid", .main = true},
                    {.key = "friction_force", .label = "friction of the threads"},
                    {.key = "cord_force", .label = "all: the cord"}}});
  return plots;
}

std::vector<Loop> pair_loops() {
  return {{"torque", "Joint angle and torque of both muscles", "angle", "torque", "joint angle in deg",
           "torque in N m"},
          {"tension_1", "Joint angle and force of cord 1", "angle", "tension_1", "joint angle in deg",
           "force in N"},
          {"tension_2", "Joint angle and force of cord 2", "angle", "tension_2", "joint angle in deg",
           "force in N"},
          pressure_loop("1"),
          pressure_loop("2")};
}

std::vector<Loop> single_loops() {
  return {{"force", "Force of the cord and contraction", "contraction", "cord_force", std::string(ratio_unit),
           "force in N"},
          {"pressure", "Pressure and contraction", "contraction", "muscle_pressure", std::string(ratio_unit),
           "muscle pressure in bar"}};
}

}  // namespace mckibben::report
