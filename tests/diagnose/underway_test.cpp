// Runs that began on their way: what effects remember of before is fitted, and not charged to the rig; and
// what a given pressure leaves to be seen.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/priors.hpp>
#include <sim/run/follow.hpp>
#include <sim/run/replay.hpp>

#include "residuals.hpp"

namespace mckibben::diagnose {
namespace {

/// A muscle under a given pressure, whose creep was 12 mm from rest when the recording began.
domain::Dataset begun_on_its_way(plant::Rig& creeping) {
  auto& creep = creeping.effects.get<plant::BladderCreep>();
  creep.stiffness_N_per_m = 300.0;
  creep.time_s = 2.0;
  domain::Dataset data;
  data.own_clock = true;
  data.recorded.start = domain::Start::moving;
  data.rows_of_stamps = domain::Rows{.row_s = 0.02};
  domain::Run& run = data.runs.emplace_back();
  run.load_kg = 12.0;
  run.rest_length_m = data.rig.muscle.rest_length_m;
  domain::Measurement& measured = run.measured.emplace();
  measured.recorded = data.recorded;
  measured.first = {0.19, 0.0, 0.0, {}};
  for (int k = 0; k < 150; ++k) {
    measured.time_s.push_back(0.02 * k);
    measured.give("muscle_pressure").push_back(2e5 - 5e4 * std::cos(0.1 * k));
  }
  for (std::size_t k = 15; k < 150; ++k) measured.rows.push_back(k);
  const Loaded hanging{creeping, run.load_kg};
  const double memory = 0.12;
  run.read("contraction");
  run.judged().values = predict(run, {&hanging, 1}, solver::Method::automatic, {&memory, 1}).front().judged();
  return data;
}

double mean_square(const Eigen::VectorXd& residuals) {
  return residuals.squaredNorm() / static_cast<double>(residuals.size());
}

TEST(Underway, WhatAnEffectRemembersIsFittedAndNotCharged) {
  plant::Rig creeping;
  const domain::Dataset data = begun_on_its_way(creeping);
  const Experiment experiment(data, {std::vector<bool>(data.runs[0].rows())}, 1);
  EXPECT_LT(mean_square(residuals_of(experiment, creeping, {0})), 1.0);  // within the floor
  const Loaded hanging{creeping, 12.0};
  EXPECT_GT(mean_square(experiment.residuals(predict(data.runs[0], {&hanging, 1}).front(), 0)), 100.0);

  domain::Dataset known = data;  // a replay finds the memory as well
  known.rig = creeping;
  EXPECT_LT(run::replay(known, 1, [](const auto&, auto, auto) {}).front().gaps.front().rmse, 1e-5);

  plant::Rig stiffer = creeping;  // a wrong rig stays wrong
  stiffer.effects.get<plant::BladderCreep>().stiffness_N_per_m = 320.0;
  EXPECT_GT(mean_square(residuals_of(experiment, stiffer, {0})), 0.5);
}

// Valve and muscle are behind a moving command when the recording begins, and a late command is one from
// before it.
TEST(Underway, WithoutAGaugePressuresComeFromHowCommandsGoOn) {
  domain::Dataset data;
  data.rig.effects.get<plant::CommandDelay>().time_s = 0.04;
  run::Course course;
  for (int k = 0; k < 600; ++k) {
    course.time_s.push_back(0.01 * k);
    course.drives.emplace_back().current_mA = 9.0 - 4.0 * std::cos(0.5 * std::numbers::pi * 0.01 * k);
    course.rows.push_back(static_cast<std::size_t>(k));
  }
  const run::Recording whole = run::follow(data.rig, 12.0, course);
  constexpr std::size_t from = 130, to = 330;  // rising
  domain::Run& run = data.runs.emplace_back();
  data.own_clock = true;
  data.recorded.start = domain::Start::moving;
  run.load_kg = 12.0;
  run.rest_length_m = data.rig.muscle.rest_length_m;
  domain::Measurement& measured = run.measured.emplace();
  measured.recorded = data.recorded;
  const auto ratio = [&](std::size_t k) { return whole.samples[k].state.joint.contraction_ratio; };
  const auto& first = whole.samples[from].state.joint;
  measured.first = {first.contraction_ratio,
                    first.contraction_speed_per_s,
                    (ratio(from + 1) - 2.0 * ratio(from) + ratio(from - 1)) / 1e-4,
                    {}};
  run.read("contraction");
  for (std::size_t k = from; k < to; ++k) {
    measured.rows.push_back(measured.time_s.size());
    measured.time_s.push_back(course.time_s[k]);
    measured.give("command").push_back(course.drives[k].current_mA);
    run.judged().values.push_back(ratio(k));
  }
  const auto replayed = run::replay(data, 1, [](const auto&, auto, auto) {});
  EXPECT_LT(replayed.front().gaps.front().largest, 4e-4);  // 2.5e-3 by the first command alone
}

// What an encoder shows late, or on another scale, a replay compares as a diagnosis does.
TEST(Underway, AReplayReadsWhatADiagnosisReads) {
  plant::Rig rig;
  rig.effects.get<plant::EncoderScale>().error = 0.02;
  rig.effects.get<plant::ReadingDelay>().time_s = 0.05;
  domain::Dataset data = begun_on_its_way(rig);
  EXPECT_GT(run::replay(data, 1, [](const auto&, auto, auto) {}).front().gaps.front().rmse, 1e-3);
  rig.effects.get<plant::BladderCreep>() = {};
  data.rig = rig;
  const Loaded hanging{rig, data.runs[0].load_kg};
  data.runs[0].judged().values = predict(data.runs[0], {&hanging, 1}).front().judged();
  EXPECT_LT(run::replay(data, 1, [](const auto&, auto, auto) {}).front().gaps.front().rmse, 1e-5);
}

TEST(Underway, AGivenPressureLeavesValveHoseAndGasOutOfSight) {
  domain::Dataset given;
  given.runs.emplace_back().measured.emplace().give("muscle_pressure");
  const auto all = catalogue(), seen = catalogue(given);
  const auto names = effects_out_of_sight(given);
  EXPECT_EQ(names.size(), 9u);
  EXPECT_EQ(seen.size() + names.size(), all.size());  // each of them has one law
  for (const Candidate& c : seen) EXPECT_EQ(std::count(names.begin(), names.end(), c.effect), 0) << c.effect;
  for (const auto name :
       {plant::MuscleLeak::name, plant::GasTemperature::name, plant::ExhaustRestriction::name})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  EXPECT_TRUE(std::ranges::any_of(seen, [](const Candidate& c) { return c.effect == "gauge_error"; }));
  domain::Dataset blind;
  blind.runs.emplace_back();
  for (const Candidate& c : catalogue(blind)) EXPECT_NE(c.effect, "gauge_error");
  for (const Parameter& p : nominal_parameters({}))
    EXPECT_EQ(out_of_sight(given, p),
              p.path.starts_with("valve") || p.path.starts_with("hose") || p.path == "muscle.dead_volume")
        << p.path;
}

}  // namespace
}  // namespace mckibben::diagnose
