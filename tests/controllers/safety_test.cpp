// Limits that every controller with feedback or a model keeps, and counts that stop or jump.
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <controllers/model_inverse.hpp>
#include <controllers/pid.hpp>

#include "believed.hpp"

namespace mckibben::controllers {
namespace {

enum class Counter { works, jumps, stops };

struct Went {
  std::vector<double> currents_mA, ratios;
  std::vector<Finding> findings;
};

/// From rest to 0.15 at tick 50, on a rig solved by hand; from tick 150 on the counter may be broken.
Went went(const auto& settings, Counter counter = Counter::works) {
  Knowledge known;
  known.contraction_per_count = 4e-4;
  known.tick_s = 0.012;
  known.largest_current_mA = 20.0;
  known.target.assign(400, 0.05);
  for (std::size_t k = 50; k < 400; ++k) known.target[k] = k < 200 ? 0.15 : 0.05;
  known.model = {0.0075, 0.3, 0.4, 1.0, false};
  known.valve = {4.0, 20.0, 0.5e5, 5e5};
  const auto controller = settings.make(known);
  Believed rig({}, 12.0, 4.0);
  Went all;
  std::int64_t counts = 0;
  for (std::int64_t k = -controller->preparation_ticks(); k < 400; ++k) {
    const auto now = static_cast<std::int64_t>(std::floor(rig.shown_ratio() / 4e-4));
    if (k < 150 || counter != Counter::stops) counts = now;
    const std::int64_t shown = k >= 150 && counter == Counter::jumps ? counts + 1000 : counts;
    const double current_mA = rig.given_mA(controller->step({k, 0.0, shown}).current_mA);
    rig.step(current_mA);
    if (k < 0) continue;
    all.currents_mA.push_back(current_mA);
    all.ratios.push_back(rig.contraction_ratio());
  }
  all.findings = controller->findings();
  return all;
}

PidSettings pid() {
  PidSettings settings;
  settings.proportional_mA = 20.0;
  settings.integral_time_s = 0.1;
  settings.derivative_time_s = 0.0;
  settings.fastest_load_per_s = 10.0;
  return settings;
}

template <class Settings>
Settings with_model() {
  Settings settings;
  settings.model = believed({});
  settings.fastest_load_per_s = 10.0;
  return settings;
}

template <class Settings>
void keeps_its_limits(Settings settings) {
  settings.largest_current_speed_mA_per_s = 5.0;
  settings.highest_target = 0.10;
  const Went all = went(settings);
  double highest = 0.0;
  for (std::size_t k = 1; k < all.currents_mA.size(); ++k) {
    EXPECT_LE(std::abs(all.currents_mA[k] - all.currents_mA[k - 1]), 5.0 * 0.012 + 1.0 / 256.0) << k;
    highest = std::max(highest, all.ratios[k]);
  }
  EXPECT_LT(highest, 0.13) << Settings::kind;
  EXPECT_GT(highest, 0.09) << Settings::kind;
}

TEST(Safety, SpeedOfTheCurrentAndHeightOfTheTargetAreKept) {
  keeps_its_limits(pid());
  keeps_its_limits(with_model<ModelInverseSettings>());
  keeps_its_limits(with_model<ModelInverseFeedbackSettings>());
}

TEST(Safety, APidHoldsItsCurrentWhileCountsJump) {
  const Went all = went(pid(), Counter::jumps);
  for (std::size_t k = 150; k < 400; ++k) ASSERT_EQ(all.currents_mA[k], all.currents_mA[149]);
  EXPECT_EQ(value_of(all.findings, "ticks_without_counts"), 250.0);
  EXPECT_TRUE(went(pid()).findings.empty());
}

TEST(Safety, AModelGoesOnWithoutCountsThatJumpOrStop) {
  const auto settings = with_model<ModelInverseFeedbackSettings>();
  const Went sound = went(settings);
  for (const Counter counter : {Counter::jumps, Counter::stops}) {
    const Went all = went(settings, counter);
    EXPECT_NEAR(all.ratios.back(), 0.05, 0.06) << static_cast<int>(counter);
    EXPECT_GT(
        value_of(all.findings, "ticks_without_counts") + value_of(all.findings, "ticks_counts_contradict"),
        0.0);
  }
  EXPECT_NEAR(sound.ratios.back(), 0.05, 0.002);
  EXPECT_NEAR(went(settings, Counter::jumps).ratios.back(), 0.05, 0.002);
}

}  // namespace
}  // namespace mckibben::controllers
