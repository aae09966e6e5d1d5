// Targets against the limits of a made-up rig: up at 0.5 /s,
// down at 0.25 /s, from 0.01 (from above 0.03) to 0.2.
#include <vector>

#include <gtest/gtest.h>

#include <sim/run/compare.hpp>
#include <sim/run/unreachable.hpp>

#include "says.hpp"

namespace mckibben::run {
namespace {

constexpr double each_s = 0.012, count = 4.363e-4;

controllers::Reach even_reach() {
  controllers::Reach reach;
  reach.ratio = {0.0, 0.3};
  controllers::ReachOfLoad load;
  load.load_kg = 16.0;
  load.lowest_rising = 0.01;
  load.lowest_falling = 0.03;
  load.highest = 0.2;
  load.rising_per_s = {0.5, 0.5};
  load.falling_per_s = {0.25, 0.25};
  load.rising_lag_s = load.falling_lag_s = {0.0, 0.0};
  reach.loads = {load};
  return reach;
}

Unreachable look(const std::vector<double>& target) {
  const auto reach = even_reach();
  return unreachable(target, each_s, reach, reach.at_load(16.0), count);
}

std::vector<double> ramp(double from, double to, double speed_per_s) {
  std::vector<double> target{from};
  const double step = speed_per_s * each_s;
  while (step > 0.0 ? target.back() + step < to : target.back() + step > to)
    target.push_back(target.back() + step);
  return target;
}

TEST(Unreachable, WhatTheRigCanDoIsNotWarnedOf) {
  EXPECT_FALSE(look(ramp(0.02, 0.19, 0.49)).any());
  EXPECT_FALSE(look(ramp(0.19, 0.04, -0.24)).any());
  EXPECT_FALSE(look(std::vector<double>(50, 0.2 + 0.5 * count)).any()) << "less than a count is no height";
}

TEST(Unreachable, TooFastNamesTicksAndTheLargestSpeed) {
  const auto target = ramp(0.02, 0.19, 0.8);
  const Unreachable found = look(target);
  EXPECT_EQ(found.ticks, target.size() - 1);
  EXPECT_EQ(found.too_fast.ticks, target.size() - 1);
  EXPECT_NEAR(found.too_fast.asked, 0.8, 1e-9);
  EXPECT_EQ(found.too_fast.limit, 0.5);
  EXPECT_TRUE(holds(found.text(), "the largest reachable speed there is 0.5 /s", "a slower target"));
}

TEST(Unreachable, HeightsDependOnTheDirectionTheyAreReachedFrom) {
  EXPECT_EQ(look({0.02, 0.02, 0.02}).ticks, 0u);
  const Unreachable from_above = look({0.05, 0.05 - 0.002, 0.046, 0.02, 0.02});
  EXPECT_EQ(from_above.too_low.ticks, 2u);
  EXPECT_EQ(from_above.too_low.limit, 0.03);
  const Unreachable high = look({0.19, 0.195, 0.2, 0.205, 0.21});
  EXPECT_EQ(high.too_high.ticks, 2u);
  EXPECT_EQ(high.too_high.asked, 0.21);
  EXPECT_TRUE(holds(high.text(), "the largest reachable one, coming slowly, is 0.200"));
  EXPECT_TRUE(lacks(high.text(), "slower")) << "time does not lift it";
}

TEST(Unreachable, HeightsAreToldOnceOfAllThatFollowThem) {
  domain::Scenario scenario;
  scenario.duration_s = 1.0;
  scenario.loads_kg = {40.0};
  scenario.target = controllers::StepsOf<controllers::Height>{.start = {0.02}, .moves = {{0.1, {0.18}}}};
  controllers::PidSettings one;
  one.name = "one";
  one.proportional_mA = 10.0;
  one.integral_time_s = 0.3;
  one.derivative_time_s = 0.03;
  controllers::PidSettings two = one;
  two.name = "two";
  two.proportional_mA = 20.0;
  scenario.controllers = {one, two, controllers::StepCurrent{.start_mA = 8.0, .moves = {}}};
  const auto said = [&] {
    std::string all;
    for (const auto& line :
         compare(scenario, 1, [](const std::string&, std::size_t, std::size_t) {}).warnings)
      all += line + "\n";
    return all;
  };
  const std::string warned = said();
  EXPECT_TRUE(
      holds(warned, "2 runs (one at 40 kg, two at 40 kg): the target is out of reach at ", " too high"))
      << warned;
  EXPECT_TRUE(lacks(warned, "too fast")) << "a controller with feedback is given steps";
  scenario.loads_kg = {16.0};
  EXPECT_TRUE(lacks(said(), "out of reach"));
}

TEST(Unreachable, OnePointAtOneSpeed) {
  const auto reach = even_reach();
  const auto limits = reach.at_load(16.0);
  EXPECT_FALSE(unreachable(0.1, 0.4, reach, limits).any());
  EXPECT_TRUE(unreachable(0.1, -0.4, reach, limits).any()) << "down it is slower";
  EXPECT_FALSE(unreachable(0.1, -0.4, reach, limits).too_fast.up);
  EXPECT_EQ(unreachable(0.25, 0.1, reach, limits).too_high.ticks, 1u);
}

TEST(Unreachable, AModelWithoutACurrentSpeedIsSaidToo) {
  Unreachable found = look({0.1, 0.1});
  found.ticks_without_current_speed = 3;
  EXPECT_TRUE(found.any());
  EXPECT_TRUE(holds(found.text(), "at 3 ticks the calibrated model has no current speed"));
}

}  // namespace
}  // namespace mckibben::run
