// What data sheets of sensors and regulators add to the noise floor, and readings at the end of a range.
#include <cmath>

#include <gtest/gtest.h>

#include <sim/diagnose/check.hpp>
#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/fit.hpp>
#include <sim/diagnose/priors.hpp>

#include "planted.hpp"

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
  const Checked checked = check(data, 2);
  EXPECT_EQ(checked.left_out, Runs{});
  EXPECT_EQ(std::count(checked.masked[0].begin(), checked.masked[0].end(), true), 0);
  const Experiment experiment(data, checked.masked, 2, both_loads);
  const NoiseFloor& floor = experiment.floor();
  EXPECT_EQ(floor.middle, 0.0);
  EXPECT_FALSE(floor.noisy);
  const double l0 = data.rig.muscle.rest_length_m;
  EXPECT_NEAR(floor.judged * l0, std::hypot(2e-4 / std::sqrt(12.0), 1e-4), 2e-5);
  const auto residuals = experiment.residuals(data.rig, both_loads);
  EXPECT_NEAR(experiment.rmse(residuals, both_loads), floor.judged, 0.1 * floor.judged);
  EXPECT_LT(std::abs(residuals.mean()), 0.15);  // half a step up would make 0.7
}

TEST(Sensors, AnotherZeroIsFoundWhereTheRigSaysHowWellItIsKnown) {
  plant::Rig truth = with_laser();
  truth.joint.reading_offset_m = -4e-4;
  domain::Dataset data = read_by(truth, with_laser());
  const auto offset = [&] {
    const Experiment experiment(data, check(data, 2).masked, 2, both_loads);
    const Fitted fitted =
        fit(experiment, {data.rig, nominal_parameters(data.rig, data.rig.spreads)}, both_loads, {});
    return value_of(fitted.model.rig, "joint.reading_offset");
  };
  EXPECT_EQ(offset(), 0.0);
  data.rig.spreads["joint.reading_offset"] = 1e-3;
  EXPECT_NEAR(offset(), -4e-4, 6e-5);
}

TEST(Sensors, AccuracyCountsInTheFloor) {
  const domain::Dataset data = read_by(with_laser(), with_laser(3e-4));
  const Experiment experiment(data, check(data, 2).masked, 2, both_loads);
  const double l0 = data.rig.muscle.rest_length_m;
  EXPECT_NEAR(experiment.floor().accuracy * l0, 3e-4, 1e-9);
  EXPECT_GT(experiment.floor().judged * l0, 3e-4);
}

TEST(Sensors, RowsAtTheEndOfTheRangeDoNotCount) {
  plant::Rig rig = with_laser();
  rig.sensors.position().highest = 0.03;
  const domain::Dataset data = read_by(rig, rig);
  const Checked checked = check(data, 2);
  std::size_t ended = 0;
  for (const double ratio : data.runs[0].contraction_ratio)
    ended += ratio * rig.muscle.rest_length_m > 0.0299 ? 1 : 0;
  ASSERT_GT(ended, 10u);
  EXPECT_GE(std::count(checked.masked[0].begin(), checked.masked[0].end(), true),
            static_cast<std::ptrdiff_t>(ended));
  ASSERT_FALSE(checked.warnings.empty());
  EXPECT_NE(checked.warnings[0].find("at the end of the sensor's range"), std::string::npos)
      << checked.warnings[0];
}

TEST(Sensors, WhatARegulatorDoesNotRepeatCountsInTheFloor) {
  plant::Rig rig;
  rig.valve.kind = plant::ValveKind::regulator;
  rig.valve.time_constant_s = 0.1;
  const domain::Dataset exact = read_by(rig, rig);
  rig.valve.repeatability_Pa = 2000.0;
  const domain::Dataset data = read_by(rig, rig);
  EXPECT_EQ(data.runs[0].contraction_ratio, exact.runs[0].contraction_ratio);  // not simulated
  const Experiment before(exact, check(exact, 2).masked, 2, both_loads);
  const Experiment after(data, check(data, 2).masked, 2, both_loads);
  EXPECT_EQ(before.floor().command, 0.0);
  // 20 mbar of 2.5 bar or so move the load by about as large a share of its way.
  EXPECT_GT(after.floor().command, 3e-4);
  EXPECT_LT(after.floor().command, 3e-3);
  EXPECT_NEAR(after.floor().judged, std::hypot(before.floor().judged, after.floor().command), 1e-9);
}

}  // namespace
}  // namespace mckibben::diagnose
