// Currents that settings leave open follow the valve; for the thesis's valve they are the thesis's.
#include <gtest/gtest.h>

#include <controllers/settings.hpp>

namespace mckibben::controllers {
namespace {

constexpr CurrentRange thesis{4.0, 20.0}, other{0.0, 10.0};

Knowledge of_valve(const CurrentRange& range) {
  Knowledge knowledge;
  knowledge.largest_current_mA = 20.0;
  knowledge.valve = {range.lowest_mA, range.highest_mA, 0.0, 5e5};
  return knowledge;
}

TEST(CurrentRange, IsTheValvesAsFarAsTheDacReaches) {
  Knowledge knowledge = of_valve(other);
  EXPECT_EQ(working_range(knowledge).highest_mA, 10.0);
  knowledge.largest_current_mA = 8.0;
  EXPECT_EQ(working_range(knowledge).lowest_mA, 0.0);
  EXPECT_EQ(working_range(knowledge).highest_mA, 8.0);
}

TEST(CurrentRange, OpenLimitsFollowIt) {
  for (const CurrentRange& range : {thesis, other}) {
    PidSettings pid;
    pid.follow(range);
    EXPECT_EQ(pid.lowest_current_mA, range.lowest_mA);
    EXPECT_EQ(pid.highest_current_mA, range.highest_mA);
    EXPECT_EQ(pid.rest_current_mA, range.lowest_mA);
    StepCurrent steps;
    steps.follow(range);
    EXPECT_EQ(steps.at(0.0), range.lowest_mA);
  }
}

// Valves that are both shut in the middle begin there: at the lowest command they would vent.
TEST(CurrentRange, ALoopRestsWhereTheValveDoesNothing) {
  constexpr CurrentRange shut_at_5{0.0, 10.0, 5.0};
  PidSettings pid;
  pid.follow(shut_at_5);
  EXPECT_EQ(pid.rest_current_mA, 5.0);
  PidSettings above;
  above.lowest_current_mA = 6.0;
  above.follow(shut_at_5);
  EXPECT_EQ(above.rest_current_mA, 6.0) << "within its limits";
  PidSettings given;
  given.rest_current_mA = 3.0;
  given.follow(shut_at_5);
  EXPECT_EQ(given.rest_current_mA, 3.0);
}

TEST(CurrentRange, WeighingFollowsItInTheThesissProportions) {
  OpenLoopSettings settings;
  settings.follow(thesis);
  EXPECT_EQ(settings.weighing.low_mA, 4.0);
  EXPECT_EQ(settings.weighing.high_mA, 8.0);
  EXPECT_EQ(settings.weighing.speed_mA_per_s, 6.0);
  OpenLoopSettings slower;
  slower.model.range = {.lowest_speed_mA_per_s = 1.0, .highest_speed_mA_per_s = 4.5};
  slower.follow(thesis);
  EXPECT_EQ(slower.weighing.speed_mA_per_s, 4.5) << "the calibration knows none of 6 mA/s";
  WeighingSettings weighing;
  weighing.follow(other);
  EXPECT_EQ(weighing.low_mA, 0.0);
  EXPECT_EQ(weighing.high_mA, 2.5);
  EXPECT_EQ(weighing.speed_mA_per_s, 3.75);
}

TEST(CurrentRange, WhatIsGivenStays) {
  PidSettings pid;
  pid.lowest_current_mA = 2.0;
  pid.follow(other);
  EXPECT_EQ(pid.lowest_current_mA, 2.0);
  EXPECT_EQ(pid.rest_current_mA, 2.0) << "rests at its own limit";
  StepCurrent steps{.start_mA = 5.0, .moves = {}};
  steps.follow(other);
  EXPECT_EQ(steps.start_mA, 5.0);
}

TEST(CurrentRange, OnlyControllersHaveLimits) {
  const Knowledge knowledge = of_valve(other);
  PidSettings pid;
  pid.highest_current_mA = 30.0;
  EXPECT_EQ(limits_of(pid, knowledge)->lowest_mA, 0.0);
  EXPECT_EQ(limits_of(pid, knowledge)->highest_mA, 20.0) << "the DAC's";
  EXPECT_EQ(limits_of(StaticInverseSettings{}, knowledge)->highest_mA, 10.0);
  EXPECT_EQ(limits_of(OpenLoopSettings{}, knowledge)->highest_mA, 10.0);
  EXPECT_FALSE(limits_of(StepCurrent{}, knowledge));
  OpenLoopSettings triangle;
  triangle.mode = OpenLoopMode::triangle;
  EXPECT_FALSE(limits_of(triangle, knowledge)) << "begins and ends there on purpose";
}

}  // namespace
}  // namespace mckibben::controllers
