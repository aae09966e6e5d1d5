// Data for the tests: samples made by the thesis's formulas, and a small campaign on the simulated rig.
#pragma once

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <controllers/settings.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/run/simulate.hpp>
#include <sim/thesis/cells.hpp>

namespace mckibben::thesis {

/// Cells at these loads and speeds whose contraction ratios run from 0.005 to 0.25; pressure_Pa and
/// coefficient are what `pressure` and `coefficient` give for (e, load, speed).
template <class Pressure, class Coefficient>
Grid planted_grid(const std::vector<double>& loads_kg, const std::vector<double>& speeds,
                  const Pressure& pressure, const Coefficient& coefficient) {
  Grid grid;
  grid.loads_kg = loads_kg;
  grid.speeds_mA_per_s = speeds;
  for (auto& cells : grid.cells)
    for (const double load : loads_kg)
      for (const double speed : speeds) {
        Cell cell{load, speed, {}};
        for (int i = 0; i < 200; ++i) {
          const double e = 0.005 + 0.245 * i / 199.0;
          cell.samples.contraction_ratio.push_back(e);
          cell.samples.pressure_Pa.push_back(pressure(e, load, speed));
          cell.samples.coefficient.push_back(coefficient(e, load, speed));
        }
        cells.push_back(std::move(cell));
      }
  return grid;
}

/// A ride of the thesis's rig under a sine of 0 to 20 mA, as a data set would hold it.
inline domain::Run ride(double load_kg, double period_s, double cycles = 3.0, const plant::Rig& rig = {}) {
  run::RunPlan plan;
  plan.rig = rig;
  plan.load_kg = load_kg;
  plan.rig.sensors.put(plant::gauge());
  plan.ticks = static_cast<std::size_t>(std::llround(cycles * period_s / plan.rig.tick_s));
  controllers::SineCurrent sine;
  sine.low_mA = 0.0;
  sine.high_mA = 20.0;
  sine.period_s = period_s;
  const auto controller = sine.make(run::knowledge_of(plan.rig, {}));
  const auto recording = run::simulate(plan, *controller);
  domain::Run result;
  result.id = fmt::format("m{:.0f}_{:.0f}", 1e3 * load_kg, 1e3 * period_s);
  result.load_kg = load_kg;
  result.read("contraction");
  result.read("muscle_pressure");
  for (const auto& sample : recording.samples) {
    result.current_mA.push_back(sample.current_mA);
    result.judged().values.push_back(static_cast<double>(sample.counts) *
                                     run::contraction_per_count(plan.rig));
    result.find("muscle_pressure")->values.push_back(sample.shown[plant::Sensed::muscle_pressure]);
  }
  return result;
}

inline domain::Dataset small_campaign(const std::vector<double>& loads_kg = {11.138, 13.870, 16.138, 18.870,
                                                                             23.406},
                                      const std::vector<double>& periods_s = {2.4, 3.6, 4.8, 6.0},
                                      const plant::Rig& rig = {}) {
  domain::Dataset dataset;
  dataset.rig = rig;
  dataset.path = "small/dataset.yaml";
  for (const double load : loads_kg)
    for (const double period : periods_s) dataset.runs.push_back(ride(load, period, 3.0, rig));
  return dataset;
}

}  // namespace mckibben::thesis
