// Wanted movements against their formulas, at and between their knots.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <controllers/target.hpp>

namespace mckibben::controllers {
namespace {

constexpr double rest_length_m = 0.3;

Height ratio(double value) {
  return {value, false};
}
Height metres(double value) {
  return {value, true};
}

// Keeps the keys that rules() complains about.
template <class Settings>
std::vector<std::string> complaints(const Settings& settings) {
  std::vector<std::string> keys;
  auto report = [&](std::string_view key, std::string_view) { keys.emplace_back(key); };
  settings.rules(report);
  return keys;
}
using Keys = std::vector<std::string>;

TEST(Height, LengthIsDividedByRestLength) {
  EXPECT_DOUBLE_EQ(metres(0.03).ratio(rest_length_m), 0.1);
  EXPECT_DOUBLE_EQ(ratio(0.2).ratio(rest_length_m), 0.2);
}

TEST(Steps, AreRightContinuous) {
  const Steps steps{ratio(0.05), {{1.0, ratio(0.1)}, {2.0, metres(0.06)}}};
  EXPECT_DOUBLE_EQ(steps.at(0.0, rest_length_m), 0.05);
  EXPECT_DOUBLE_EQ(steps.at(1.0 - 1e-6, rest_length_m), 0.05);
  EXPECT_DOUBLE_EQ(steps.at(1.0, rest_length_m), 0.1);
  EXPECT_DOUBLE_EQ(steps.at(99.0, rest_length_m), 0.2);
}

TEST(Steps, RoundingOfTheTickNeverMovesAStep) {
  for (const double tick_ms :
       {9.0, 11.0, 12.0}) {  // k * 0.009 falls below the written time for half of all k
    for (std::size_t k = 1; k < 1000; ++k) {
      const Target steps = Steps{ratio(0.0), {{static_cast<double>(k) * tick_ms / 1000.0, ratio(0.1)}}};
      const auto heights = sample(steps, k + 1, tick_ms / 1000.0, rest_length_m);
      ASSERT_EQ(heights[k], 0.1) << k << " ticks of " << tick_ms << " ms";
      ASSERT_EQ(heights[k - 1], 0.0) << k << " ticks of " << tick_ms << " ms";
    }
  }
}

TEST(Ramps, RiseInProportionAndHold) {
  const Ramps ramps{ratio(0.05), {{1.0, 2.0, ratio(0.15)}, {5.0, 1.0, ratio(0.0)}}};
  EXPECT_DOUBLE_EQ(ramps.at(0.5, rest_length_m), 0.05);
  EXPECT_DOUBLE_EQ(ramps.at(1.5, rest_length_m), 0.075);
  EXPECT_DOUBLE_EQ(ramps.at(4.0, rest_length_m), 0.15);
  EXPECT_DOUBLE_EQ(ramps.at(5.25, rest_length_m), 0.1125);
  EXPECT_DOUBLE_EQ(ramps.at(7.0, rest_length_m), 0.0);
}

TEST(MinimumJerk, HasTheQuinticsPeakSpeedAndNoSpeedAtTheEnds) {
  const MinimumJerk move{ratio(0.0), {{1.0, 2.0, ratio(0.1)}}};
  const auto speed = [&](double t) {
    return (move.at(t + 1e-4, rest_length_m) - move.at(t - 1e-4, rest_length_m)) / 2e-4;
  };
  EXPECT_NEAR(move.at(2.0, rest_length_m), 0.05, 1e-15);
  EXPECT_NEAR(speed(2.0), 1.875 * 0.1 / 2.0, 1e-8);
  EXPECT_NEAR(speed(1.0), 0.0, 1e-8);
  EXPECT_NEAR(speed(3.0), 0.0, 1e-8);
  EXPECT_DOUBLE_EQ(move.at(3.0, rest_length_m), 0.1);
}

TEST(Sine, BeginsAtTheMeanAfterItsDelay) {
  const Sine sine{ratio(0.15), metres(0.03), 4.0, 0.5};
  EXPECT_DOUBLE_EQ(sine.at(0.3, rest_length_m), 0.15);
  EXPECT_NEAR(sine.at(1.5, rest_length_m), 0.25, 1e-15);
  EXPECT_NEAR(sine.at(3.5, rest_length_m), 0.05, 1e-15);
}

TEST(Triangle, BeginsAtLow) {
  const Triangle triangle{ratio(0.1), ratio(0.2), 4.0, 1.0};
  EXPECT_DOUBLE_EQ(triangle.at(0.5, rest_length_m), 0.1);
  EXPECT_DOUBLE_EQ(triangle.at(2.0, rest_length_m), 0.15);
  EXPECT_DOUBLE_EQ(triangle.at(3.0, rest_length_m), 0.2);
  EXPECT_DOUBLE_EQ(triangle.at(4.5, rest_length_m), 0.125);
  EXPECT_DOUBLE_EQ(triangle.at(9.0, rest_length_m), 0.1);
}

TEST(Points, AreJoinedByStraightLinesAndHeldOutside) {
  const Points points{{{1.0, ratio(0.1)}, {3.0, ratio(0.2)}, {4.0, ratio(0.0)}}};
  EXPECT_DOUBLE_EQ(points.at(0.0, rest_length_m), 0.1);
  EXPECT_DOUBLE_EQ(points.at(1.5, rest_length_m), 0.125);
  EXPECT_DOUBLE_EQ(points.at(3.0, rest_length_m), 0.2);
  EXPECT_DOUBLE_EQ(points.at(3.5, rest_length_m), 0.1);
  EXPECT_DOUBLE_EQ(points.at(50.0, rest_length_m), 0.0);
}

TEST(Target, LastChangeIsTheEndOfTheLastMove) {
  EXPECT_EQ(last_change_s(Target(Steps{ratio(0.0), {{1.0, ratio(0.1)}, {2.5, ratio(0.0)}}})), 2.5);
  EXPECT_EQ(last_change_s(Target(Steps{ratio(0.1), {}})), 0.0);
  EXPECT_EQ(last_change_s(Target(MinimumJerk{ratio(0.0), {{1.0, 2.0, ratio(0.1)}}})), 3.0);
  EXPECT_EQ(last_change_s(Target(Points{{{1.0, ratio(0.1)}, {3.0, ratio(0.2)}}})), 3.0);
  EXPECT_EQ(last_change_s(Target(Sine{ratio(0.1), ratio(0.05), 1.0, 0.0})), std::nullopt);
}

TEST(Target, RangeSeesExtremesBetweenTicksAndStopsAtTheDuration) {
  const Target sine = Sine{ratio(0.15), ratio(0.05), 4.0, 0.0};
  const auto [sine_low, sine_high] = range(sine, 2.0, rest_length_m);
  EXPECT_NEAR(sine_low, 0.15, 1e-15);
  EXPECT_NEAR(sine_high, 0.20, 1e-15);
  const Target steps = Steps{ratio(0.05), {{1.0, ratio(0.2)}, {2.0, ratio(0.1)}, {9.0, ratio(0.9)}}};
  EXPECT_EQ(range(steps, 5.0, rest_length_m), std::pair(0.05, 0.2));
}

TEST(TargetRules, AcceptWhatIsInOrder) {
  EXPECT_EQ(complaints(Steps{ratio(0.0), {{1.0, ratio(0.1)}, {2.0, ratio(0.2)}}}), Keys{});
  EXPECT_EQ(complaints(Ramps{ratio(0.0), {{0.1, 0.2, ratio(0.1)}, {0.3, 1.0, ratio(0.2)}}}), Keys{});
  EXPECT_EQ(complaints(Triangle{ratio(0.1), ratio(0.2), 1.0, 0.0}), Keys{});
}

TEST(TargetRules, NameTheKeyThatIsWrong) {
  EXPECT_EQ(complaints(Steps{ratio(0.0), {{1.0, ratio(0.1)}, {1.0, ratio(0.2)}}}), Keys{"moves"});
  EXPECT_EQ(complaints(Ramps{ratio(0.0), {{1.0, 1.5, ratio(0.1)}, {2.0, 1.0, ratio(0.2)}}}), Keys{"moves"});
  EXPECT_EQ(complaints(Steps{ratio(30.0), {}}), Keys{"start"});
  EXPECT_EQ(complaints(Move{1.0, ratio(-1.1)}), Keys{"to"});
  EXPECT_EQ(complaints(Triangle{ratio(0.2), ratio(0.1), 1.0, 0.0}), Keys{"high"});
  EXPECT_EQ(complaints(Triangle{ratio(0.1), metres(0.1), 1.0, 0.0}), Keys{"high"});
  EXPECT_EQ(complaints(Sine{ratio(0.1), ratio(0.0), 1.0, 0.0}), Keys{"amplitude"});
  EXPECT_EQ(complaints(Points{}), Keys{"points"});
}

}  // namespace
}  // namespace mckibben::controllers
