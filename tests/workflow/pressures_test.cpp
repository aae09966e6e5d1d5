// Whole diagnoses of data in which nothing but pressures was read.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/data/judged.hpp>
#include <sim/data/parts.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/predict.hpp>

#include "diagnose/planted.hpp"
#include "named.hpp"

namespace mckibben::diagnose {
namespace {

constexpr double tick_s = 0.012, noise_Pa = 300.0;

/// A command that swings and then steps.
double command_mA(double time_s, double period_s, double lasts_s) {
  if (time_s > 0.6 * lasts_s) return time_s > 0.8 * lasts_s ? 6.0 : 15.0;
  return 10.0 - 6.0 * std::cos(2.0 * std::numbers::pi * time_s / period_s);
}

/// What a gauge reads in `truth`, handed over with `described`; a run for each period. `give`: puts the
/// inputs.
template <class Give>
domain::Dataset pressures_of(const plant::Rig& truth, const plant::Rig& described,
                             const std::vector<double>& periods_s, double lasts_s, const Give& give) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.0, noise_Pa);
  domain::Dataset data;
  data.rig = described;
  data.own_clock = true;
  data.path = "pressures/dataset.yaml";
  for (const double period_s : periods_s) {
    domain::Run& run = data.runs.emplace_back();
    run.id = fmt::format("r{}", data.runs.size());
    run.load_kg = truth.lifts_a_load() ? 11.138 : 0.0;
    domain::Measurement& measured = run.measured.emplace();
    for (int k = 0; k * tick_s < lasts_s; ++k) {
      measured.time_s.push_back(tick_s * k);
      give(measured, command_mA(measured.time_s.back(), period_s, lasts_s));
    }
    run.read("muscle_pressure");
    const Loaded one{truth, run.load_kg};
    std::vector<double> read_Pa = predict(run, {&one, 1}).front().judged();
    run.readings.clear();
    for (double& Pa : read_Pa) Pa += normal(random);
    measured.take("muscle_pressure") = std::move(read_Pa);
  }
  return data::in_parts(data::with_rows(std::move(data)));
}

void command(domain::Measurement& measured, double mA) {
  measured.give("command").push_back(mA);
}

TEST(PressuresAlone, NameALeakUnderALoadThatNobodyWatched) {
  plant::Rig truth;
  truth.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 3e-10;
  const domain::Dataset data = pressures_of(truth, {}, {4.0, 2.0, 1.0, 0.5}, 4.0, command);
  ASSERT_EQ(data.judged(), domain::Judged::pressure);
  const Diagnosis found = diagnosis_of(data, 2);
  ASSERT_TRUE(names_only(found, "muscle_leak"));
  EXPECT_TRUE(surrounds(found.effects[0].parameters.at(0), 3e-10));
  EXPECT_LT(found.gap.corrected_rmse, 1.2 * found.gap.noise_floor);
}

TEST(PressuresAlone, OfOneLongRunAtAHeldLengthTellTheVolumeAndTheExhaust) {
  plant::Rig described;
  described.mechanics = plant::HeldLength{};
  described.muscle.dead_volume_m3 = 2e-5;
  described.spreads["muscle.dead_volume"] = 1e-5;
  plant::Rig truth = described;
  truth.muscle.dead_volume_m3 = 3.1e-5;
  truth.effects.get<plant::ExhaustRestriction>().share = 0.4;
  const domain::Dataset data = pressures_of(truth, described, {1.3}, 10.0, [](auto& measured, double mA) {
    command(measured, mA);
    measured.give("contraction").push_back(0.0);
  });
  ASSERT_EQ(data.runs.size(), 4u);
  EXPECT_TRUE(data.parts_of_a_run);
  const Diagnosis found = diagnosis_of(data, 2);
  ASSERT_TRUE(names_only(found, "exhaust_restriction"));
  EXPECT_TRUE(surrounds(found.effects[0].parameters.at(0), 0.4));
  const auto volume = std::ranges::find_if(
      found.recalibrated, [](const auto& one) { return one.fitted.name == "muscle.dead_volume"; });
  ASSERT_NE(volume, found.recalibrated.end());
  EXPECT_TRUE(surrounds(volume->fitted, 3.1e-5));
}

TEST(PressuresAlone, SayAGaugesZeroInTheUnitOfItsColumn) {
  domain::Dataset data = pressures_of({}, {}, {4.0, 2.0, 1.0, 0.5}, 4.0, command);
  data.columns["muscle_pressure"] = {"p_kPa", "kPa"};
  for (double& read_Pa : data.runs[2].judged().values) read_Pa += 5000.0;
  const Diagnosis found = diagnosis_of(data, 2);
  ASSERT_EQ(found.bench.size(), 1u);
  EXPECT_EQ(found.bench[0].name, "zeros_differ");
  EXPECT_EQ(found.bench[0].runs, std::vector<std::string>{"r3"});
  const std::string line = "columns: {muscle_pressure: {column: p_kPa, unit: kPa, zero: ";
  ASSERT_TRUE(found.bench[0].write.starts_with(line)) << found.bench[0].write;
  EXPECT_NEAR(std::stod(found.bench[0].write.substr(line.size())), 5.0, 0.2);
}

/// Filled to 2, 2.5, 3 bar and so on, run by run, and shut.
TEST(PressuresAlone, OfASealedMuscleNameItsLeak) {
  plant::Rig described;
  described.mechanics = plant::HeldLength{};
  described.valve.kind = plant::ValveKind::none;
  plant::Rig truth = described;
  truth.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 1e-10;
  double filled_Pa = 1.5e5;
  const domain::Dataset data =
      pressures_of(truth, described, {4.0, 2.0, 1.0, 0.5}, 6.0, [&](auto& measured, double) {
        if (!measured.filled_Pa) measured.filled_Pa = filled_Pa += 0.5e5;
        measured.give("contraction").push_back(0.0);
      });
  ASSERT_EQ(data.judged(), domain::Judged::pressure);
  const auto hidden = effects_out_of_sight(data);
  EXPECT_EQ(std::ranges::count(hidden, plant::ValveLag::name), 1);
  EXPECT_EQ(std::ranges::count(hidden, plant::MuscleLeak::name), 0);
  const Diagnosis found = diagnosis_of(data, 2);
  ASSERT_TRUE(names_only(found, "muscle_leak"));
  EXPECT_TRUE(surrounds(found.effects[0].parameters.at(0), 1e-10));
  EXPECT_LT(found.gap.corrected_rmse, 1.2 * found.gap.noise_floor);
}

TEST(PressuresAlone, BehindAGivenValvePressureTellOnlyOfHoseAndMuscle) {
  plant::Rig truth;
  truth.effects.get<plant::PolytropicGas>().exponent = 1.3;
  const domain::Dataset data =
      pressures_of(truth, {}, {4.0, 2.0, 1.0, 0.5}, 4.0, [](auto& measured, double mA) {
        measured.give("valve_pressure").push_back(0.5e5 + 4.5e5 * (mA - 4.0) / 16.0);
      });
  const auto hidden = effects_out_of_sight(data);
  EXPECT_EQ(std::ranges::count(hidden, plant::SupplyDroop::name), 1);
  EXPECT_EQ(std::ranges::count(hidden, plant::PolytropicGas::name), 0);
  const Diagnosis found = diagnosis_of(data, 2);
  ASSERT_TRUE(names_only(found, "polytropic_gas"));
  EXPECT_TRUE(surrounds(found.effects[0].parameters.at(0), 1.3));
}

}  // namespace
}  // namespace mckibben::diagnose
