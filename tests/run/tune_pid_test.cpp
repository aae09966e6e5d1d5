// The search for gains, on costs whose best gains are known.
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include <plant/valve.hpp>
#include <sim/run/tune_pid.hpp>

namespace mckibben::run {
namespace {

// A bowl in the logarithms, with its bottom at 120 mA, 0.25 s, 0.05 s.
double bowl(const Gains& gains) {
  const double p = std::log(gains.proportional_mA / 120.0);
  const double i = std::log(gains.integral_time_s / 0.25);
  const double d = std::log(gains.derivative_time_s / 0.05);
  return 1.0 + p * p + i * i + 0.5 * p * i + 0.3 * d * d;
}

TEST(Tune, FindsTheBottomOfABowl) {
  const Tuned tuned = tune(bowl);
  EXPECT_NEAR(tuned.gains.proportional_mA, 120.0, 6.0);
  EXPECT_NEAR(tuned.gains.integral_time_s, 0.25, 0.0125);
  EXPECT_NEAR(tuned.gains.derivative_time_s, 0.05, 0.0025);
  EXPECT_EQ(tuned.cost, bowl(tuned.gains));
  EXPECT_LE(tuned.evaluations, 150);
}

TEST(Tune, LeavesGivenGainsAlone) {
  int calls = 0;
  const auto counted = [&](const Gains& gains) {
    ++calls;
    EXPECT_EQ(gains.derivative_time_s, 0.0);
    return bowl({gains.proportional_mA, gains.integral_time_s, 0.05});
  };
  const Tuned tuned = tune(counted, {.derivative_time_s = 0.0});
  EXPECT_EQ(tuned.gains.derivative_time_s, 0.0);
  EXPECT_NEAR(tuned.gains.proportional_mA, 120.0, 6.0);
  EXPECT_EQ(tuned.evaluations, calls);
}

TEST(Tune, WithAllGainsGivenEvaluatesOnce) {
  const Tuned tuned = tune(bowl, {120.0, 0.25, 0.05});
  EXPECT_EQ(tuned.evaluations, 1);
  EXPECT_NEAR(tuned.cost, 1.0, 1e-12);
}

TEST(Tune, StepsRoundGainsThatCannotBeSimulated) {
  const auto brittle = [](const Gains& gains) {
    if (gains.proportional_mA > 150.0) throw std::runtime_error("integration failed");
    if (gains.integral_time_s < 0.1) return std::numeric_limits<double>::quiet_NaN();
    return bowl(gains);
  };
  const Tuned tuned = tune(brittle);
  EXPECT_NEAR(tuned.gains.proportional_mA, 120.0, 12.0);
  EXPECT_NEAR(tuned.gains.integral_time_s, 0.25, 0.025);
}

TEST(Tune, StaysWithinItsBoundsAndItsNumberOfEvaluations) {
  TuningOptions options;
  options.highest.proportional_mA = 60.0;
  options.evaluations = 120;
  int calls = 0;
  const auto watched = [&](const Gains& gains) {
    ++calls;
    EXPECT_LE(gains.proportional_mA, 60.0 * (1.0 + 1e-12));
    return bowl(gains);
  };
  const Tuned tuned = tune(watched, {}, options);
  EXPECT_LE(calls, 120);
  EXPECT_LT(tuned.cost, bowl(options.start));
}

TEST(Tune, BeginsWithAGainThatFitsTheValvesSpan) {
  const TuningOptions thesis, half = TuningOptions::for_span(0.5 * plant::thesis_span_mA);
  EXPECT_EQ(half.start.proportional_mA, 0.5 * thesis.start.proportional_mA);
  EXPECT_EQ(half.highest.proportional_mA, 0.5 * thesis.highest.proportional_mA);
  EXPECT_EQ(half.start.integral_time_s, thesis.start.integral_time_s);
  const Tuned tuned = tune(bowl, {}, half);
  EXPECT_NEAR(tuned.start_cost.value(), bowl(half.start), 1e-9);
  EXPECT_LT(tuned.cost, *tuned.start_cost);
}

// On a rig whose loop swings with the gains of the start: there only the swing is made a little smaller, down
// to a bottom of its own, and good gains are a tenth.
TEST(Tune, FindsItsWayOutOfSwings) {
  const auto swings = [](const Gains& gains) {
    const double p = std::log(gains.proportional_mA / 60.0), i = std::log(gains.integral_time_s / 0.02),
                 d = std::log(gains.derivative_time_s / 0.1);
    const double swing = 5.0 + 0.1 * (p * p + i * i + d * d);
    return std::min(swing + std::max(p, 0.0),
                    bowl({20.0 * gains.proportional_mA, gains.integral_time_s, gains.derivative_time_s}));
  };
  const Tuned tuned = tune(swings);
  EXPECT_NEAR(tuned.gains.proportional_mA, 6.0, 0.5);
  EXPECT_NEAR(tuned.cost, 1.0, 0.01);
  EXPECT_GT(tuned.start_cost.value(), 5.0);
}

TEST(Tune, SameCostGivesTheSameGains) {
  const Tuned first = tune(bowl), second = tune(bowl);
  EXPECT_EQ(first.gains.proportional_mA, second.gains.proportional_mA);
  EXPECT_EQ(first.gains.integral_time_s, second.gains.integral_time_s);
  EXPECT_EQ(first.gains.derivative_time_s, second.gains.derivative_time_s);
}

TEST(Tune, SaysSoIfNothingCanBeSimulated) {
  EXPECT_THROW(tune([](const Gains&) -> double { throw std::runtime_error("no"); }), std::runtime_error);
  EXPECT_THROW(tune([](const Gains&) { return std::numeric_limits<double>::infinity(); }),
               std::runtime_error);
}

TEST(Tune, DefectsAreNotTakenForBadGains) {
  EXPECT_THROW(tune([](const Gains&) -> double { throw std::logic_error("defect"); }), std::logic_error);
}

}  // namespace
}  // namespace mckibben::run
