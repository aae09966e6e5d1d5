// What data sheets of sensors and regulators add to the noise floor.
#include <cmath>

#include <gtest/gtest.h>

#include <sim/diagnose/experiment.hpp>

#include "planted.hpp"
#include "residuals.hpp"

namespace mckibben::diagnose {
namespace {

const Runs both_loads{0, 1};

/// Two loads under a sine, read by the sensor that `truth` has; `sheet` is the rig that is handed over.
domain::Dataset read_by(const plant::Rig& truth, const plant::Rig& sheet) {
  auto currents = three_kinds();
  currents.resize(1);
  currents[0].duration_s = 2.5;
  return planted(truth, {11.138, 16.138}, currents, 5, sheet);
}

plant::Rig with_laser(double accuracy_m = 0.0) {
  plant::Rig rig;
  rig.sensors.position().kind = plant::SensorKind::laser;
  rig.sensors.position().resolution = 2e-4;
  rig.sensors.position().noise = 1e-4;
  rig.sensors.position().accuracy = accuracy_m;
  return rig;
}

TEST(Sensors, ALaserRoundsToTheNearestAndLeavesItsNoise) {
  const domain::Dataset data = read_by(with_laser(), with_laser());
  const Experiment experiment(data, nothing_masked(data), 2, both_loads);
  const NoiseFloor& floor = experiment.floor();
  EXPECT_EQ(floor.middle, 0.0);
  EXPECT_FALSE(floor.noisy);
  const double l0 = data.rig.muscle.rest_length_m;
  EXPECT_NEAR(floor.judged * l0, std::hypot(2e-4 / std::sqrt(12.0), 1e-4), 2e-5);
  const auto residuals = residuals_of(experiment, data.rig, both_loads);
  EXPECT_NEAR(experiment.rmse(residuals, both_loads), floor.judged, 0.1 * floor.judged);
  EXPECT_LT(std::abs(residuals.mean()), 0.15);  // half a step up would make 0.7
}

TEST(Sensors, AccuracyCountsInTheFloor) {
  const domain::Dataset data = read_by(with_laser(), with_laser(3e-4));
  const Experiment experiment(data, nothing_masked(data), 2, both_loads);
  const double l0 = data.rig.muscle.rest_length_m;
  EXPECT_NEAR(experiment.floor().accuracy * l0, 3e-4, 1e-9);
  EXPECT_GT(experiment.floor().judged * l0, 3e-4);
}

TEST(Sensors, WhatARegulatorDoesNotRepeatCountsInTheFloor) {
  plant::Rig rig;
  rig.valve.kind = plant::ValveKind::regulator;
  rig.valve.time_constant_s = 0.1;
  const domain::Dataset exact = read_by(rig, rig);
  rig.valve.repeatability_Pa = 2000.0;
  const domain::Dataset data = read_by(rig, rig);
  EXPECT_EQ(data.runs[0].judged().values, exact.runs[0].judged().values);  // not simulated
  const Experiment before(exact, nothing_masked(exact), 2, both_loads);
  const Experiment after(data, nothing_masked(data), 2, both_loads);
  EXPECT_EQ(before.floor().command, 0.0);
  // 20 mbar of 2.5 bar or so move the load by about as large a share of its way.
  EXPECT_GT(after.floor().command, 3e-4);
  EXPECT_LT(after.floor().command, 3e-3);
  EXPECT_NEAR(after.floor().judged, std::hypot(before.floor().judged, after.floor().command), 1e-9);
}

}  // namespace
}  // namespace mckibben::diagnose
