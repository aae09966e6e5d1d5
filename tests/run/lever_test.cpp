// A forearm: what is read of it, what a target in angles comes to, and what its data sets hold.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <plant/signals.hpp>
#include <sim/domain/columns.hpp>
#include <sim/run/compare.hpp>
#include <sim/run/follow.hpp>
#include <sim/run/track.hpp>

#include "campaign_runs.hpp"

namespace mckibben::run {
namespace {

constexpr double one_deg = plant::degree_rad;

plant::Rig forearm() {
  plant::Rig rig;
  plant::Lever lever;
  lever.damping_N_m_s_per_rad = 0.3;
  lever.spring_N_m_per_rad = 1.5;
  rig.mechanics = lever;
  rig.joint.lowest_rad = 0.0;
  return rig;
}

TEST(Lever, ItsSignalsAreThoseOfAnAngle) {
  std::vector<std::string> names;
  for (const plant::Channel& channel : plant::channels_of(forearm(), {.joint_force = true}))
    names.push_back(channel.name());
  const auto has = [&](const char* name) { return std::ranges::find(names, name) != names.end(); };
  for (const char* name : {"contraction_ratio", "angle_rad", "angle_speed_rad_per_s", "encoder_angle_rad",
                           "muscle_pressure_bar", "torque_Nm", "joint_torque_Nm"})
    EXPECT_TRUE(has(name)) << name;
  for (const char* name : {"encoder_contraction_ratio", "joint_force_N", "stiffness_Nm_per_rad"})
    EXPECT_FALSE(has(name)) << name;
  const auto belongs = [](const char* key, const plant::Rig& rig) {
    return domain::quantity_of(key).belongs(rig);
  };
  for (const char* key : {"angle", "joint_torque"})
    EXPECT_TRUE(belongs(key, forearm()) && !belongs(key, plant::Rig{})) << key;
  for (const char* key : {"contraction", "joint_force"})
    EXPECT_TRUE(!belongs(key, forearm()) && belongs(key, plant::Rig{})) << key;
  EXPECT_TRUE(belongs("command", forearm()) && belongs("force", forearm()));
  EXPECT_FALSE(belongs("command_1", forearm()));
}

domain::Scenario raised() {
  domain::Scenario scenario;
  scenario.rig = forearm();
  scenario.duration_s = 6.0;
  scenario.loads_kg = {0.5, 1.5};
  controllers::MinimumJerkOf<controllers::Angle> angle;
  angle.start.value = 20.0 * one_deg;
  angle.moves = {{1.0, 1.0, {60.0 * one_deg}}};
  scenario.angle = angle;
  controllers::LeverPidSettings pid;
  pid.proportional_mA = 6.0;  // for a radian: the wheel turns as far for a tenth of the muscle's length
  pid.integral_time_s = 0.3;
  pid.derivative_time_s = 0.03;
  scenario.controllers = {pid};
  return scenario;
}

const ProgressHook in_silence = [](const std::string&, std::size_t, std::size_t) {};

controllers::StepCurrent held_at(double current_mA) {
  return {.start_mA = current_mA, .moves = {}};
}

// At rest, with threads that rub or not: torque of the cord and from outside against weight and spring.
TEST(Lever, ATorqueOfAScenarioTurnsIt) {
  domain::Scenario scenario = raised();
  scenario.loads_kg = {1.5};
  scenario.controllers = {held_at(9.0)};
  scenario.outer_torques = {{1.0, 1.2}};
  const Comparison all = compare(scenario, 1, in_silence);
  ASSERT_EQ(all.runs.front().failure, "");
  const auto& rows = all.runs.front().recording.samples;
  const Sample &first = rows.front(), &last = rows.back();
  EXPECT_EQ(first.joint_torque_N_m, 0.0);
  EXPECT_NEAR(last.joint_torque_N_m, 1.2, 1e-12);
  EXPECT_GT(last.angle_rad, first.angle_rad + one_deg);
  EXPECT_NEAR(last.torque_N_m + 1.2,
              9.80665 * 0.6 * std::sin(last.angle_rad + 30.0 * one_deg) + 1.5 * last.angle_rad, 2e-3);
}

TEST(Lever, ATorqueOfAScenarioTurnsAPair) {
  domain::Scenario scenario = domain::pair_scenario();
  scenario.duration_s = 5.0;
  scenario.currents = {{"held", held_at(12.0), held_at(12.0)}};
  scenario.outer_torques = {{0.5, 3.0}, {2.0, -3.0}};
  const Comparison all = compare(scenario, 1, in_silence);
  ASSERT_EQ(all.runs.front().failure, "");
  const auto& rows = all.runs.front().recording.samples;
  EXPECT_GT(rows[rows.size() * 3 / 10].angle_rad, one_deg);
  const Sample& last = rows.back();
  EXPECT_LT(last.angle_rad, -one_deg);
  EXPECT_NEAR(last.torque_N_m - 3.0, 2.0 * 9.80665 * 0.25 * std::sin(last.angle_rad), 5e-3);
}

TEST(Lever, ItIsSaidWhereARunDoesNotBeginAtRest) {
  domain::Scenario scenario = raised();
  scenario.loads_kg = {1.5};
  scenario.controllers = {held_at(9.0)};
  scenario.duration_s = 0.5;
  const auto says = [&] {
    std::string all;
    for (const std::string& warning : compare(scenario, 1, in_silence).warnings) all += warning;
    return all.find("after settling_time") != std::string::npos;
  };
  EXPECT_FALSE(says());
  scenario.rig.settling_time_s = 0.24;
  EXPECT_TRUE(says());
  scenario.skip_s = 0.2;
  EXPECT_FALSE(says());
}

TEST(Lever, APidRaisesItToTheAngle) {
  const domain::Scenario scenario = raised();
  const Comparison all = compare(scenario, 1, in_silence);
  ASSERT_EQ(all.runs.size(), 2u);
  const std::vector<Wanted> wanted = wanted_of(scenario);
  EXPECT_NEAR(wanted.front().values.back(), 60.0 * one_deg, 1e-12);
  for (const TrackedRun& run : all.runs) {
    ASSERT_EQ(run.failure, "");
    const Sample& last = run.recording.samples.back();
    EXPECT_NEAR(last.angle_rad, 60.0 * one_deg, 1.0 * one_deg);
    EXPECT_NEAR(last.read_angle_rad, last.angle_rad, 0.3 * one_deg);  // a count is 0.25 deg
    EXPECT_NEAR(run.metrics.final_error, last.angle_rad - 60.0 * one_deg, 1e-9);
    EXPECT_LT(run.metrics.rmse, 6.0 * one_deg);
    // c of points 30 cm and 5 cm away, 150 deg apart at first
    const auto c = [](double angle) { return std::sqrt(0.0925 - 0.03 * std::cos(150.0 * one_deg - angle)); };
    EXPECT_NEAR(last.state.joint.contraction_ratio, (c(0.0) - c(last.angle_rad)) / 0.3, 1e-9);
    const double arm_m = 0.015 * std::sin(150.0 * one_deg - last.angle_rad) / c(last.angle_rad);
    EXPECT_NEAR(last.torque_N_m, arm_m * last.cord_force_N, 1e-9);
  }
  // A load of 1.5 kg in the hand takes more than one of 0.5 kg.
  const auto torque = [&](std::size_t i) { return all.runs[i].recording.samples.back().torque_N_m; };
  EXPECT_NEAR(torque(1) - torque(0), 9.80665 * 0.3 * std::sin(90.0 * one_deg), 0.3);
}

TEST(Lever, RestsOnItsStopAndOnItsMuscle) {
  const plant::Rig rig = forearm();
  Course course;
  for (int k = 0; k < 300; ++k) {
    course.time_s.push_back(0.012 * k);
    course.drives.emplace_back().current_mA = k < 100 ? 4.0 : 14.0;
    course.rows.push_back(static_cast<std::size_t>(k));
  }
  const Recording recording = follow(rig, 8.0, course);
  ASSERT_EQ(recording.failure, "");
  EXPECT_LT(recording.samples.front().angle_rad, 0.0);
  EXPECT_GT(recording.samples.front().angle_rad, -3.0 * one_deg);  // by as much as stop and threads give
  EXPECT_GT(recording.samples.back().angle_rad, 5.0 * one_deg);
  EXPECT_LT(recording.imbalance.energy, 1e-6);
}

TEST(Lever, ItsDataSetHoldsItsAngle) {
  domain::Campaign campaign;
  campaign.rig = forearm();
  campaign.loads_kg = {1.0};
  controllers::TriangleCurrent triangle;
  triangle.low_mA = 8.0;
  triangle.high_mA = 16.0;
  triangle.period_s = 3.0;
  campaign.currents = {{"triangle", 3.0, triangle}};
  const CampaignRun run = run_job(campaign, jobs_of(campaign).front());
  ASSERT_EQ(run.recording.failure, "");
  const domain::Run table = measured(campaign, run);
  EXPECT_EQ(table.find("contraction"), nullptr);
  ASSERT_EQ(table.rows(), run.recording.samples.size());
  EXPECT_EQ(table.judged().values.back(), run.recording.samples.back().read_angle_rad);
  EXPECT_GT(ended(campaign, run).angle_rad.high, 20.0 * one_deg);
}

}  // namespace
}  // namespace mckibben::run
