// Processing of one run: half periods, speeds, directions,
// and friction coefficients that were put in by the thesis's formulas.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <plant/geometry.hpp>
#include <sim/data/finding.hpp>
#include <sim/thesis/cells.hpp>
#include <sim/thesis/processing.hpp>

#include "small_campaign.hpp"

namespace mckibben::thesis {
namespace {

std::vector<double> sine(int samples_a_period, int rows) {
  std::vector<double> current;
  for (int k = 0; k < rows; ++k) {
    const double wanted = 10.0 * (1.0 - std::cos(2.0 * std::numbers::pi * k / samples_a_period));
    current.push_back(plant::dac_output_mA({}, wanted));
  }
  return current;
}

TEST(HalfPeriods, OfTheThesissSinesHaveItsSpeeds) {
  for (const int n : {200, 300, 600}) {
    const auto halves = half_periods(sine(n, 5 * n));
    ASSERT_EQ(halves.size(), 10u);
    for (std::size_t i = 1; i + 1 < halves.size(); ++i) {
      EXPECT_NEAR(halves[i].speed_mA_per_s(0.012), 40.0 / (n * 0.012), 1e-9);
      EXPECT_EQ(halves[i].change_mA > 0.0, i % 2 == 0);
    }
  }
}

TEST(HalfPeriods, RestBeforeATriangleIsNotPartOfIt) {
  std::vector<double> current(50, 4.0);
  for (int k = 1; k <= 100; ++k) current.push_back(4.0 + 0.16 * k);
  for (int k = 1; k <= 100; ++k) current.push_back(20.0 - 0.16 * k);
  const auto halves = half_periods(current);
  ASSERT_EQ(halves.size(), 2u);
  EXPECT_NEAR(halves[0].speed_mA_per_s(0.012), 0.16 / 0.012, 1e-9);
  EXPECT_NEAR(halves[1].speed_mA_per_s(0.012), 0.16 / 0.012, 1e-9);
}

TEST(HalfPeriods, AConstantCurrentHasNone) {
  EXPECT_TRUE(half_periods(std::vector<double>(100, 7.0)).empty());
  EXPECT_TRUE(half_periods({}).empty());
}

/// Up and down in steps of two counts, the pressure always as T 4.1
/// to 4.3 ask for these friction coefficients.
domain::Run planted_run(const plant::Rig& rig, double load_kg, double contraction, double relaxation) {
  const plant::Braid braid(rig.muscle);
  const double per_count = plant::count_height_m(rig) / rig.muscle.rest_length_m;
  domain::Run run;
  run.id = "planted";
  run.load_kg = load_kg;
  run.read("contraction");
  const auto add = [&](int counts, double signed_coefficient) {
    const double e = (counts + 0.5) * per_count;
    const double pressure = load_kg * plant::gravity_m_per_s2 /
                            (braid.force_N(e, 1.0) - signed_coefficient * braid.contact_surface_m2(e));
    run.current_mA.push_back(4.0 + 16.0 * (pressure - 0.5e5) / 4.5e5);
    run.judged().values.push_back(counts * per_count);
  };
  for (int counts = 10; counts <= 480; counts += 2) add(counts, contraction);
  for (int counts = 478; counts >= 10; counts -= 2) add(counts, -relaxation);
  return run;
}

TEST(Processing, RecoversPlantedCoefficientsInBothDirections) {
  domain::Dataset dataset;
  for (const auto surface : {plant::ContactSurface::squared, plant::ContactSurface::printed}) {
    dataset.rig.muscle.contact_surface = surface;
    ProcessingOptions options;
    options.acceleration = Acceleration::neglected;
    const ProcessedRun processed = process(planted_run(dataset.rig, 16.0, 0.012, 0.013), dataset, options);
    ASSERT_EQ(processed.unusable, "");
    for (const double f : processed.of(Direction::contraction).coefficient) EXPECT_NEAR(f, 0.012, 1e-12);
    for (const double f : processed.of(Direction::relaxation).coefficient) EXPECT_NEAR(f, 0.013, 1e-12);
    EXPECT_GT(processed.of(Direction::contraction).size(), 200u);
    EXPECT_GT(processed.of(Direction::relaxation).size(), 200u);
  }
}

TEST(Processing, WhatALaserReadsIsNotTakenForCounts) {
  domain::Dataset dataset;
  domain::Run run = planted_run(dataset.rig, 16.0, 0.012, 0.013);
  const double rise_m = plant::count_height_m(dataset.rig);
  for (double& e : run.judged().values) e += 0.5 * rise_m / dataset.rig.muscle.rest_length_m;
  dataset.rig.sensors.position().pulses_per_turn = 137;
  ProcessingOptions options;
  options.acceleration = Acceleration::neglected;
  ASSERT_EQ(process(run, dataset, options).wrong.size(), 1u) << "they should be counts of this encoder";
  dataset.runs = {run, run};
  EXPECT_THROW(make_grid(dataset, options), data::UnfitData);
  dataset.columns["contraction"] = {"laser", "mm"};
  const ProcessedRun processed = process(run, dataset, options);
  ASSERT_EQ(processed.unusable, "");
  EXPECT_GT(processed.of(Direction::contraction).size(), 200u);
  for (const double f : processed.of(Direction::contraction).coefficient) EXPECT_NEAR(f, 0.012, 1e-12);
  for (const double f : processed.of(Direction::relaxation).coefficient) EXPECT_NEAR(f, 0.013, 1e-12);
}

TEST(Processing, InertiaIsTakenOffByDifferencesOfCounts) {
  domain::Dataset dataset;
  domain::Run run = planted_run(dataset.rig, 16.0, 0.012, 0.012);
  const double rise_m = plant::count_height_m(dataset.rig);
  run.judged().values[100] += rise_m / dataset.rig.muscle.rest_length_m;  // one count early
  ProcessingOptions options;
  const Samples counted = process(run, dataset, options).of(Direction::contraction);
  options.acceleration = Acceleration::neglected;
  const Samples neglected = process(run, dataset, options).of(Direction::contraction);
  const plant::Braid braid(dataset.rig.muscle);
  const double seen_m_per_s2[] = {0.0, 1.0, -2.0, 1.0, 0.0};  // times rise / tick^2, from row 99
  for (std::size_t i = 0; i < 5; ++i) {
    const std::size_t k = 97 + i;  // two rows have no differences yet
    const double normal_N = braid.contact_surface_m2(counted.contraction_ratio[k]) * counted.pressure_Pa[k];
    EXPECT_NEAR((neglected.coefficient[k] - counted.coefficient[k]) * normal_N,
                16.0 * seen_m_per_s2[i] * rise_m / (0.012 * 0.012), 1e-6);
  }
}

TEST(Processing, DirectionsOfASineAreApartAndEveryRowIsAccountedFor) {
  domain::Dataset dataset;
  const domain::Run run = ride(16.138, 3.6);
  const ProcessedRun processed = process(run, dataset, {});
  ASSERT_EQ(processed.unusable, "");
  EXPECT_NEAR(processed.current_speed_mA_per_s, 40.0 / 3.6, 1e-9);
  const auto& up = processed.of(Direction::contraction);
  const auto& down = processed.of(Direction::relaxation);
  EXPECT_EQ(up.size() + down.size() + processed.dropped.all(), run.current_mA.size());
  const auto mean = [](const std::vector<double>& v) { return vector(v).mean(); };
  EXPECT_GT(mean(up.coefficient), 0.0);
  EXPECT_GT(mean(down.coefficient), 0.0);
  for (const double pressure : up.pressure_Pa) EXPECT_GT(pressure, 0.5e5);  // nothing from the dead part
  EXPECT_GT(vector(up.contraction_ratio).minCoeff(), 0.0);
}

// The mean of a staircase, so much in so long, is no speed of its current.
TEST(Processing, AStaircaseHasNoSpeedButASlowRampHas) {
  domain::Dataset dataset;
  domain::Run run = ride(16.138, 3.6);
  const auto every = [&](std::size_t rows) {
    domain::Run held = run;
    for (std::size_t k = 0; k < held.current_mA.size(); ++k)
      held.current_mA[k] = run.current_mA[k / rows * rows];
    return process(held, dataset, {}).unusable;
  };
  EXPECT_EQ(every(1), "");
  EXPECT_EQ(every(2), "") << "a command that is sampled slower than the reading";
  EXPECT_NE(every(30).find("its current goes in steps, of up to "), std::string::npos) << every(30);
}

TEST(Processing, TheGaugeIsUsedWhenAskedFor) {
  domain::Dataset dataset;
  const domain::Run run = ride(16.138, 3.6);
  ProcessingOptions options;
  options.pressure = PressureSource::gauge;
  const auto gauge = process(run, dataset, options), line = process(run, dataset, {});
  // The muscle lags behind the current: less pressure while it contracts.
  EXPECT_LT(vector(gauge.of(Direction::contraction).pressure_Pa).mean(),
            vector(line.of(Direction::contraction).pressure_Pa).mean());
}

}  // namespace
}  // namespace mckibben::thesis
