// Rigs drawn within what is stated of them, and what counts as a failure on them.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <sim/domain/rig_number.hpp>
#include <sim/run/compare.hpp>

namespace mckibben::run {
namespace {

constexpr double apart_s = 0.012;

Followed followed(const std::vector<double>& target, const std::vector<double>& contraction) {
  return {.target = target, .contraction = contraction, .current_mA = {}, .tick_s = apart_s};
}

/// Up in a second, then three seconds of rest with an oscillation of so much, for so long.
std::pair<std::vector<double>, std::vector<double>> resting(double amplitude, double lasting_s) {
  std::vector<double> target, contraction;
  for (int k = 0; k < 333; ++k) {
    const double time_s = apart_s * k;
    target.push_back(0.1 * std::min(time_s, 1.0));
    const double swings = time_s < 1.0 + lasting_s ? amplitude : 0.0;
    contraction.push_back(target.back() + swings * std::sin(2.0 * std::numbers::pi * 2.0 * time_s));
  }
  return {target, contraction};
}

TEST(Robustness, ALoadThatGoesRoundAndRoundWhereItsTargetRestsIsALimitCycle) {
  const auto swings = [](double amplitude, double lasting_s) {
    const auto [target, contraction] = resting(amplitude, lasting_s);
    return limit_cycle(followed(target, contraction)).has_value();
  };
  EXPECT_TRUE(swings(1e-3, 3.0));
  EXPECT_FALSE(swings(4e-4, 3.0)) << "less than the way that counts";
  EXPECT_FALSE(swings(5e-3, 1.0)) << "it comes to rest";
  EXPECT_FALSE(swings(0.0, 3.0));
  const auto [target, contraction] = resting(2e-3, 3.0);
  const auto found = limit_cycle(followed(target, contraction));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->amplitude, 2e-3, 5e-5);
  EXPECT_NEAR(found->period_s, 0.5, 0.012);
}

TEST(Robustness, ALoadThatRingsOutIsNoLimitCycleAndOneThatSwingsBeforeTheFirstMoveIs) {
  const auto swings = [](double rests_s, double dies_s) {
    std::vector<double> target, contraction;
    for (double time_s = 0.0; time_s < rests_s + 1.0; time_s += apart_s) {
      target.push_back(time_s < rests_s ? 0.1 : 0.1 + 0.02 * (time_s - rests_s));
      contraction.push_back(target.back() + (time_s < rests_s ? 0.025 * std::exp(-time_s / dies_s) : 0.0) *
                                                std::sin(14.0 * time_s));
    }
    return limit_cycle(followed(target, contraction)).has_value();
  };
  EXPECT_TRUE(swings(1.05, 1e6)) << "15 mm, 0.45 s";
  EXPECT_TRUE(swings(1.05, 2.0)) << "hardly dies";
  EXPECT_FALSE(swings(1.05, 0.6));
  EXPECT_FALSE(swings(2.0, 0.6)) << "of the second half";
}

TEST(Robustness, ATargetThatNeverRestsHasNoLimitCycle) {
  std::vector<double> target, contraction;
  for (int k = 0; k < 500; ++k) {
    target.push_back(0.1 + 0.05 * std::sin(0.05 * k));
    contraction.push_back(target.back() + 2e-3 * std::sin(0.5 * k));
  }
  EXPECT_FALSE(limit_cycle(followed(target, contraction)));
}

TEST(Robustness, BandsAreOfThoseThatEndedAndFailuresAreCountedOnce) {
  std::vector<DrawnRun> runs(22);
  for (std::size_t k = 0; k < 21; ++k) runs[k] = {.ended = true, .rmse = 1e-3 * static_cast<double>(20 - k)};
  runs[3].cycles = runs[3].saturated = true;
  runs[4].over_contracted = true;
  const RobustRow row = summed(16.0, "pid", runs);
  EXPECT_EQ(row.rigs, 22u);
  EXPECT_EQ(row.failures, 3u);
  EXPECT_EQ(row.no_result + row.limit_cycles + row.saturated + row.over_contracted, 4u);
  ASSERT_TRUE(row.rmse.has_value());
  EXPECT_NEAR(row.rmse->low, 1e-3, 1e-15);
  EXPECT_NEAR(row.rmse->median, 10e-3, 1e-15);
  EXPECT_NEAR(row.rmse->high, 19e-3, 1e-15);
  EXPECT_FALSE(summed(16.0, "pid", {DrawnRun{}}).rmse.has_value());
  EXPECT_EQ(summed(16.0, "pid", {{.ended = true}, {.why = "one"}, {.why = "other"}}).why, "rig 2: one");
  EXPECT_EQ(summed(16.0, "pid", {{.ended = true}}).why, "");
}

TEST(Robustness, DrawsWhatIsStatedWithinItsDocumentedRange) {
  plant::Rig rig;
  rig.spreads = {{"muscle.rest_radius", 1e-4}, {"muscle.end_correction", 0.2}, {"friction.scale", INFINITY}};
  const domain::Variation variation = within_stated(rig);
  ASSERT_EQ(variation.numbers.size(), 2u);
  EXPECT_EQ(variation.numbers[0].path, "muscle.end_correction");
  EXPECT_GE(variation.numbers[0].low, 1.0);
  EXPECT_EQ(variation.numbers[1].path, "muscle.rest_radius");
  EXPECT_EQ(variation.numbers[1].middle, rig.muscle.rest_radius_m);
  EXPECT_EQ(variation.numbers[1].deviation, 1e-4);
}

TEST(Robustness, DrawsKeepTheRulesBetweenTheNumbersOfARig) {
  plant::Rig rig;
  rig.valve.zero_pressure_Pa = rig.valve.exhaust_pressure_Pa = 0.0;
  rig.spreads = {{"muscle.rest_radius", 1e-4}, {"valve.zero_pressure", 3e3}};
  const domain::Variation variation = within_stated(rig);
  const plant::Rig below = within_rules(rig, variation, {7.4e-3, -2e3}),
                   above = within_rules(rig, variation, {7.4e-3, 2e3});
  EXPECT_EQ(domain::broken_rule(below), "");
  EXPECT_EQ(below.valve.zero_pressure_Pa, 0.0);
  EXPECT_EQ(below.muscle.rest_radius_m, 7.4e-3);
  EXPECT_EQ(above.valve.zero_pressure_Pa, 2e3);
}

/// Two controllers without feedback, one of which asks for too much, on rigs whose radius is known to 2 %.
domain::Scenario scenario() {
  domain::Scenario all;
  all.rig.spreads = {{"muscle.rest_radius", 1.5e-4}};
  all.loads_kg = {16.138};
  all.duration_s = 1.5;
  controllers::Sine sine;
  sine.mean = {0.08, false};
  sine.amplitude = {0.02, false};
  sine.period_s = 1.5;
  all.target = sine;
  controllers::StaticInverseSettings right, too_much;
  right.name = "right", right.assumed_load_kg = 16.138;
  too_much.name = "too_much", too_much.assumed_load_kg = 60.0;
  all.controllers = {right, too_much};
  all.robustness.rigs = 12;
  return all;
}

Comparison compared(const domain::Scenario& all, unsigned threads) {
  return compare(all, threads, [](const std::string&, std::size_t, std::size_t) {});
}

TEST(Robustness, ARigThatEndsAtARuleOfItsFileHasAResult) {
  auto all = scenario();
  all.rig.valve.zero_pressure_Pa = all.rig.valve.exhaust_pressure_Pa;
  all.rig.spreads = {{"valve.zero_pressure", 3e3}};
  const RobustRow row = compared(all, 2).robustness[0];
  EXPECT_EQ(row.no_result, 0u) << row.why;
}

TEST(Robustness, RidesEveryControllerOnTheSameDrawnRigsWhateverTheThreads) {
  const auto one = compared(scenario(), 1).robustness, two = compared(scenario(), 2).robustness;
  ASSERT_EQ(one.size(), 2u);
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_TRUE(one[i].rmse && two[i].rmse);
    EXPECT_EQ(one[i].rmse->median, two[i].rmse->median);
    EXPECT_EQ(one[i].rmse->high, two[i].rmse->high);
    EXPECT_LT(one[i].rmse->low, one[i].rmse->high);
  }
  EXPECT_EQ(one[0].controller, "right");
  EXPECT_EQ(one[0].failures, 0u);
  EXPECT_EQ(one[1].over_contracted, 12u);
  auto another = scenario();
  another.seed = 2;
  EXPECT_NE(compared(another, 2).robustness[0].rmse->median, one[0].rmse->median);
}

TEST(Robustness, IsAsTheDescribedRigWhereNothingIsKnownLessWell) {
  auto all = scenario();
  all.rig.spreads = {{"muscle.rest_radius", 1e-12}};
  const Comparison result = compared(all, 2);
  EXPECT_NEAR(result.robustness[0].rmse->low, result.runs[0].metrics.rmse, 1e-6);
  EXPECT_NEAR(result.robustness[0].rmse->high, result.runs[0].metrics.rmse, 1e-6);
}

}  // namespace
}  // namespace mckibben::run
