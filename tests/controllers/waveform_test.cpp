// Currents in time against their formulas, and playback of a recording.
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <controllers/settings.hpp>

namespace mckibben::controllers {
namespace {

TEST(SineCurrent, BeginsAndEndsItsCycleAtLow) {
  SineCurrent sine{.low_mA = 6.0, .high_mA = 10.0, .period_s = 4.0, .cycles = 2.0, .delay_s = 1.0};
  EXPECT_DOUBLE_EQ(sine.at(0.5), 6.0);
  EXPECT_NEAR(sine.at(2.0), 8.0, 1e-12);
  EXPECT_NEAR(sine.at(3.0), 10.0, 1e-12);
  EXPECT_NEAR(sine.at(7.0), 10.0, 1e-12);
  EXPECT_NEAR(sine.at(11.0), 6.0, 1e-12) << "after the last cycle it stays";
  sine.cycles.reset();
  EXPECT_NEAR(sine.at(11.0), 10.0, 1e-12);
}

TEST(TriangleCurrent, SpeedAndPeriodSayTheSame) {
  const TriangleCurrent by_period{.low_mA = 0.0, .high_mA = 20.0, .period_s = 4.8};
  const TriangleCurrent by_speed{.low_mA = 0.0, .high_mA = 20.0, .speed_mA_per_s = 40.0 / 4.8};
  EXPECT_NEAR(by_period.at(1.2), 10.0, 1e-12);
  EXPECT_NEAR(by_period.at(2.4), 20.0, 1e-12);
  EXPECT_NEAR(by_period.at(4.2), 5.0, 1e-12);
  for (double t = 0.0; t < 10.0; t += 0.31) EXPECT_NEAR(by_period.at(t), by_speed.at(t), 1e-9);
}

TEST(TriangleCurrent, WantsExactlyOneOfPeriodAndSpeed) {
  const auto complaints = [](const TriangleCurrent& triangle) {
    std::vector<std::string> keys;
    auto report = [&](std::string_view key, std::string_view) { keys.emplace_back(key); };
    triangle.rules(report);
    return keys;
  };
  EXPECT_EQ(complaints({.period_s = 1.0}).size(), 0U);
  EXPECT_EQ(complaints({.speed_mA_per_s = 1.0}).size(), 0U);
  EXPECT_EQ(complaints({}), std::vector<std::string>{"period"});
  EXPECT_EQ(complaints({.period_s = 1.0, .speed_mA_per_s = 1.0}), std::vector<std::string>{"speed"});
}

TEST(StepCurrent, IsRightContinuous) {
  const StepCurrent steps{.start_mA = 5.0, .moves = {{1.0, 12.0}, {2.0, 8.0}}};
  EXPECT_EQ(steps.at(0.999), 5.0);
  EXPECT_EQ(steps.at(1.0), 12.0);
  EXPECT_EQ(steps.at(5.0), 8.0);
}

TEST(StairCurrent, ClimbsAndComesDown) {
  const StairCurrent stair{.low_mA = 4.0, .high_mA = 20.0, .steps = 4, .dwell_s = 0.5};
  const std::vector<double> levels_mA{4, 8, 12, 16, 20, 16, 12, 8, 4, 4, 4};
  for (std::size_t i = 0; i < levels_mA.size(); ++i) {
    EXPECT_DOUBLE_EQ(stair.at(0.5 * static_cast<double>(i)), levels_mA[i]);
    EXPECT_DOUBLE_EQ(stair.at(0.5 * static_cast<double>(i) + 0.49), levels_mA[i]);
  }
}

TEST(StairCurrent, RoundingOfTheTickNeverMovesAStep) {
  const StairCurrent stair{.low_mA = 4.0, .high_mA = 20.0, .steps = 8, .dwell_s = 0.11};
  for (int level = 0; level <= 8; ++level) EXPECT_DOUBLE_EQ(stair.at(level * 10 * 0.011), 4.0 + 2.0 * level);
}

TEST(ChirpCurrent, HasTheFrequencyOfTheMoment) {
  // Phase in turns: t (1 + t/2) over 4 s: 0.5 at sqrt(2) - 1, 1 at sqrt(3) - 1, 12 at the end.
  const ChirpCurrent chirp{
      .low_mA = 8.0, .high_mA = 12.0, .first_frequency_Hz = 1.0, .last_frequency_Hz = 5.0, .lasting_s = 4.0};
  EXPECT_DOUBLE_EQ(chirp.at(0.0), 10.0);
  EXPECT_NEAR(chirp.at(std::sqrt(1.5) - 1.0), 12.0, 1e-12);
  EXPECT_NEAR(chirp.at(std::sqrt(2.0) - 1.0), 10.0, 1e-12);
  EXPECT_NEAR(chirp.at(std::sqrt(2.5) - 1.0), 8.0, 1e-12);
  EXPECT_NEAR(chirp.at(7.3), 10.0, 1e-12) << "after its end it stays";
}

TEST(Waveform, ControllerPlaysTheFormulaWhateverTheCounts) {
  const auto controller = make(SineCurrent{.low_mA = 4.0, .high_mA = 20.0, .period_s = 2.0}, {});
  EXPECT_DOUBLE_EQ(controller->rest().current_mA, 4.0);
  EXPECT_NEAR(controller->step({50, 0.5, -7}).current_mA, 12.0, 1e-12);
  EXPECT_NEAR(controller->step({100, 1.0, 900}).current_mA, 20.0, 1e-12);
  EXPECT_FALSE(controller->already_quantised());
}

TEST(RecordedCurrent, GivesEachTickItsSampleThenTheLast) {
  RecordedCurrent recorded;
  EXPECT_THROW(make(recorded, {}), std::invalid_argument);
  recorded.samples_mA = {4.1, 5.2, 6.3};
  const auto controller = make(recorded, {});
  EXPECT_TRUE(controller->already_quantised());
  EXPECT_EQ(controller->rest().current_mA, 4.1);
  EXPECT_EQ(controller->step({0, 0.0, 0}).current_mA, 4.1);
  EXPECT_EQ(controller->step({2, 0.024, 0}).current_mA, 6.3);
  EXPECT_EQ(controller->step({9, 0.108, 0}).current_mA, 6.3);
}

TEST(Settings, NameIsTheKindUnlessGiven) {
  EXPECT_EQ(name_of(PidSettings{}), "pid");
  StaticInverseSettings named;
  named.name = "blind";
  EXPECT_EQ(name_of(named), "blind");
}

}  // namespace
}  // namespace mckibben::controllers
