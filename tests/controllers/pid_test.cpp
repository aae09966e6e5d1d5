// The PID against closed forms of its parts.
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <controllers/pid.hpp>

namespace mckibben::controllers {
namespace {

constexpr double per_count = 1e-3;
constexpr double tick_s = 0.01;

Knowledge wanting(std::vector<double> target) {
  Knowledge knowledge;
  knowledge.contraction_per_count = per_count;
  knowledge.tick_s = tick_s;
  knowledge.largest_current_mA = 20.0;
  knowledge.valve = {4.0, 20.0, 0.5e5, 5.0e5};
  knowledge.target = std::move(target);
  return knowledge;
}

PidSettings gains(double proportional_mA, double integral_time_s, double derivative_time_s) {
  PidSettings settings;
  settings.proportional_mA = proportional_mA;
  settings.integral_time_s = integral_time_s;
  settings.derivative_time_s = derivative_time_s;
  settings.rest_current_mA = 10.0;
  return settings;
}

// Currents for the counts of tick 0, 1, ...
std::vector<double> play(const PidSettings& settings, const Knowledge& knowledge,
                         const std::vector<std::int64_t>& counts) {
  const auto controller = settings.make(knowledge);
  std::vector<double> currents_mA;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const auto tick = static_cast<std::int64_t>(k);
    currents_mA.push_back(
        controller->step({tick, static_cast<double>(k) * knowledge.tick_s, counts[k]}).current_mA);
  }
  return currents_mA;
}

TEST(Pid, WithoutItsGainsIsRefused) {
  PidSettings settings = gains(10.0, 1.0, 0.0);
  EXPECT_FALSE(settings.needs_tuning());
  settings.integral_time_s.reset();
  EXPECT_TRUE(settings.needs_tuning());
  EXPECT_THROW(settings.make(wanting({0.1})), std::invalid_argument);
}

TEST(Pid, ProportionalPartIsGainTimesErrorFromTheMiddleOfTheCount) {
  const auto currents_mA = play(gains(40.0, 0.0, 0.0), wanting({0.1, 0.2}), {0, 50, 200});
  EXPECT_NEAR(currents_mA[0], 10.0 + 40.0 * (0.1 - 0.0005), 1e-12);
  EXPECT_NEAR(currents_mA[1], 10.0 + 40.0 * (0.2 - 0.0505), 1e-12);
  EXPECT_NEAR(currents_mA[2], 10.0 + 40.0 * (0.2 - 0.2005), 1e-12) << "the last target holds";
}

TEST(Pid, RestsWithinItsDeadZone) {
  PidSettings settings = gains(40.0, 0.0, 0.5);
  settings.dead_zone = 0.01;
  const auto currents_mA = play(settings, wanting({0.1}), {50, 95, 104, 115, 109});
  EXPECT_NEAR(currents_mA[0], 10.0 + 40.0 * (0.1 - 0.0505), 1e-12);
  EXPECT_EQ(currents_mA[1], 10.0);
  EXPECT_EQ(currents_mA[2], 10.0);
  EXPECT_LT(currents_mA[3], 10.0 - 40.0 * 0.0155);
  EXPECT_EQ(currents_mA[4], 10.0);
  settings = gains(40.0, 1.0, 0.0);
  settings.dead_zone = 0.01;
  const auto held_mA = play(settings, wanting({0.1, 0.15, 0.105}), {95, 95, 97, 98});
  EXPECT_EQ(held_mA[2], held_mA[3]) << "the integral stands";
}

TEST(Pid, SetpointWeightScalesTheTargetInTheProportionalPart) {
  PidSettings settings = gains(40.0, 0.0, 0.0);
  settings.setpoint_weight = 0.25;
  EXPECT_NEAR(play(settings, wanting({0.1}), {20})[0], 10.0 + 40.0 * (0.025 - 0.0205), 1e-12);
}

TEST(Pid, BeginsAtTheRestCurrentAndIntegratesAConstantErrorInAStraightLine) {
  const double error = 0.05 - 0.0005;
  const auto currents_mA = play(gains(20.0, 0.5, 0.0), wanting({0.05}), std::vector<std::int64_t>(50, 0));
  for (std::size_t k = 0; k < 50; ++k)
    EXPECT_NEAR(currents_mA[k], 10.0 + 20.0 * error * static_cast<double>(k) * tick_s / 0.5, 1e-12);
}

TEST(Pid, DerivativeOfARampApproachesItsSpeedThroughTheFilter) {
  PidSettings settings = gains(5.0, 0.0, 0.2);
  settings.derivative_filter = 8.0;
  std::vector<std::int64_t> counts;
  std::vector<double> target;  // equal to the measurement, so that only the derivative acts
  for (int k = 0; k < 100; ++k) {
    counts.push_back(std::int64_t{3} * k);
    target.push_back((3.0 * k + 0.5) * per_count);
  }
  const auto currents_mA = play(settings, wanting(target), counts);
  const double a = 0.2 / (0.2 + 8.0 * tick_s);
  const double whole_mA = 5.0 * 0.2 * 3.0 * per_count / tick_s;
  for (int k = 0; k < 100; ++k)
    EXPECT_NEAR(currents_mA[static_cast<std::size_t>(k)], 10.0 - whole_mA * (1.0 - std::pow(a, k)), 1e-12);
}

TEST(Pid, TargetStepGivesNoDerivativeKick) {
  const auto with = play(gains(20.0, 0.0, 0.5), wanting({0.0, 0.1}), {0, 0, 0});
  const auto without = play(gains(20.0, 0.0, 0.0), wanting({0.0, 0.1}), {0, 0, 0});
  EXPECT_EQ(with, without);
}

TEST(Pid, OutputStaysBetweenItsLimitsAndTheDacs) {
  Knowledge knowledge = wanting({0.9, 0.9, 0.0, 0.0});
  knowledge.largest_current_mA = 15.0;
  const auto currents_mA = play(gains(1000.0, 0.0, 0.0), knowledge, {0, 0, 500, 500});
  EXPECT_EQ(currents_mA[0], 15.0);
  EXPECT_EQ(currents_mA[2], 4.0);
}

TEST(Pid, ComesOffItsLimitAtTheFirstSampleAfterTheErrorTurns) {
  // A second at the limit, then a negative error. Wound up, the integral would hold 20 mA for long after.
  PidSettings settings = gains(10.0, 0.1, 0.0);
  settings.tracking_time_s = tick_s;
  std::vector<std::int64_t> counts(100, 0);
  counts.push_back(320);
  const auto currents_mA = play(settings, wanting({0.3}), counts);
  EXPECT_EQ(currents_mA[99], 20.0);
  const double moved_mA = 10.0 * 320 * per_count;         // K term
  const double pushed_mA = 10.0 * tick_s / 0.1 * 0.2995;  // last step of the integral, not yet unwound
  EXPECT_NEAR(currents_mA[100], 20.0 - moved_mA + pushed_mA, 1e-9);

  settings.tracking_time_s = 1e6;
  EXPECT_EQ(play(settings, wanting({0.3}), counts)[100], 20.0) << "without it the integral is wound up";
}

TEST(Pid, DelayedCountsAreExactlySoOld) {
  PidSettings settings = gains(10.0, 0.0, 0.0);
  settings.feedback_delay_ticks = 3;
  const std::vector<std::int64_t> counts{7, 11, 13, 17, 19, 23, 29, 31};
  const auto currents_mA = play(settings, wanting({0.1}), counts);
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const auto seen = static_cast<double>(counts[k < 3 ? 0 : k - 3]);
    EXPECT_NEAR(currents_mA[k], 10.0 + 10.0 * (0.1 - (seen + 0.5) * per_count), 1e-12) << k;
  }
}

TEST(Pid, OutputHoldsBetweenSamples) {
  PidSettings settings = gains(10.0, 0.2, 0.1);
  settings.sample_ticks = 4;
  const std::vector<std::int64_t> counts{0, 5, 9, 14, 20, 27, 33, 38, 44, 51, 60, 71};
  const auto currents_mA = play(settings, wanting({0.1}), counts);

  PidSettings slow = settings;  // the same as a PID whose tick is four times as long
  slow.sample_ticks = 1;
  Knowledge knowledge = wanting({0.1});
  knowledge.tick_s = 4 * tick_s;
  const auto slow_mA = play(slow, knowledge, {0, 20, 44});
  for (std::size_t k = 0; k < counts.size(); ++k) EXPECT_NEAR(currents_mA[k], slow_mA[k / 4], 1e-12) << k;
}

}  // namespace
}  // namespace mckibben::controllers
