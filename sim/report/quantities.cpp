// Keys, units and labels.
#include <cmath>
#include <limits>

#include <sim/report/length.hpp>
#include <sim/report/quantities.hpp>

namespace mckibben::report {
namespace {

constexpr double least_normal_N = 50.0;      // below it a coefficient is a quotient of small numbers
constexpr double least_speed_per_s = 0.002;  // below it threads may stick, with any friction up to the level

}  // namespace

std::vector<Quantity> quantities_of(const run::Recording& recording, const plant::Plant& plant) {
  const auto* rows = &recording.samples;
  const auto of = [rows](auto value) { return [rows, value](std::size_t k) { return value((*rows)[k]); }; };
  std::vector<Quantity> all{
      {"contraction", of([](const run::Sample& s) { return s.state.joint.contraction_ratio; })},
      {"current", of([](const run::Sample& s) { return s.current_mA; })},
      {"reference_pressure",
       of([plant](const run::Sample& s) { return plant.reference_pressure_Pa(s.current_mA) / 1e5; })},
      {"valve_pressure", of([](const run::Sample& s) { return s.state.side.valve_pressure_Pa / 1e5; })},
      {"muscle_pressure", of([](const run::Sample& s) { return s.state.side.muscle_pressure_Pa / 1e5; })},
      {"braid_force", of([](const run::Sample& s) { return s.braid_force_N; })},
      {"friction_force", of([](const run::Sample& s) { return s.friction_force_N; })},
      {"friction_coefficient", of([braid = plant::Braid(plant.rig().muscle)](const run::Sample& s) {
         const double normal_N = braid.contact_surface_m2(s.state.joint.contraction_ratio) *
                                 s.state.side.muscle_pressure_Pa;  // T 4.2
         const bool slides = std::abs(s.state.joint.contraction_speed_per_s) > least_speed_per_s;
         return !slides || normal_N < least_normal_N ? std::numeric_limits<double>::quiet_NaN()
                                                     : std::abs(s.friction_force_N) / normal_N;
       })}};
  if (!plant.rig().effects.absent())
    all.push_back({"effects_pull", of([](const run::Sample& s) { return s.effects_pull_N; })});
  return all;
}

std::vector<Plot> plots_for(const plant::Rig& rig, const std::string& title, const std::string& wanted,
                            const std::string& error, bool gauge) {
  Plot pressures{"pressures",
                 "Pressures",
                 "bar",
                 {{.key = "muscle_pressure", .label = "muscle", .main = true},
                  {.key = "valve_pressure", .label = "valve"},
                  {.key = "reference_pressure", .label = "asked of the valve"}}};
  if (gauge) pressures.lines.push_back({.key = "given_pressure", .label = "measured", .given = true});
  Plot forces{"forces",
              "Forces on the load, upwards",
              "N",
              {{.key = "braid_force", .label = "braid", .main = true},
               {.key = "friction_force", .label = "friction of the threads"},
               {.key = "weight", .label = "weight of the load, downwards", .given = true}}};
  if (!rig.effects.absent()) forces.lines.push_back({.key = "effects_pull", .label = "effects of the rig"});
  std::vector<Plot> plots{
      {"height",
       title,
       std::string(ratio_unit),
       {{.key = "given_contraction", .label = wanted, .given = true},
        {.key = "contraction", .label = "contraction", .main = true}},
       true},
      {"error", error, std::string(ratio_unit), {{.key = "error", .label = "error", .main = true}}},
      {"current", "Current", "mA", {{.key = "current", .label = "current", .main = true}}},
      std::move(pressures),
      std::move(forces)};
  if (gauge)
    plots.insert(plots.begin() + 4, {"pressure_error",
                                     "Error of the pressure: simulated less measured",
                                     "bar",
                                     {{.key = "pressure_error", .label = "error", .main = true}}});
  return plots;
}

std::vector<Loop> loops() {
  return {{"pressure", "Pressure and contraction", "contraction", "muscle_pressure", std::string(ratio_unit),
           "muscle pressure in bar", false, "given_contraction", "given_pressure"},
          {"force", "Braid force and contraction", "contraction", "braid_force", std::string(ratio_unit),
           "braid force in N"},
          {"friction",
           "Friction coefficient and contraction: friction of the threads for "
           "each newton of normal force, while they slide",
           "contraction", "friction_coefficient", std::string(ratio_unit), "friction coefficient", true}};
}

std::vector<Plot> measured_plots() {
  return {{"height",
           "Contraction, as counted",
           std::string(ratio_unit),
           {{.key = "contraction", .label = "contraction", .main = true}},
           true},
          {"current", "Current", "mA", {{.key = "current", .label = "current", .main = true}}},
          {"pressures",
           "Pressures",
           "bar",
           {{.key = "reference_pressure", .label = "asked of the valve", .main = true},
            {.key = "muscle_pressure", .label = "gauge on the muscle"}}}};
}

std::vector<Loop> measured_loops() {
  return {{"current", "Contraction and pressure asked of the valve", "reference_pressure", "contraction",
           "pressure asked of the valve in bar", std::string(ratio_unit)},
          {"pressure", "Pressure and contraction", "contraction", "muscle_pressure", std::string(ratio_unit),
           "muscle pressure in bar"}};
}

}  // namespace mckibben::report
