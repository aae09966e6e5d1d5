// The controllers without feedback on a planted calibration: along a target, to one point, slowed.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <controllers/settings.hpp>

#include "planted.hpp"

namespace mckibben::controllers {
namespace {

TEST(OpenLoop, FollowsTheTargetOnTheBranchOfItsDirection) {
  const Knowledge knowledge = data_sheets(up_rest_down());
  const auto controller = with_planted_load<OpenLoopSettings>().make(knowledge);
  const auto currents_mA = play(*controller, knowledge.target.size());
  const Inverse inverse(planted_calibration(), planted_load_kg, knowledge.valve, false);
  const double w = 0.001 / 0.012;
  EXPECT_NEAR(currents_mA[60], knowledge.valve.current_mA(inverse(Branch::contraction, 0.11, w).pressure_Pa),
              1e-9);
  EXPECT_NEAR(currents_mA[200],
              knowledge.valve.current_mA(inverse(Branch::relaxation, 0.15 - 0.051, -w).pressure_Pa), 1e-9);
}

TEST(OpenLoop, HoldsTheCurrentWhileTheTargetRests) {
  const Knowledge knowledge = data_sheets(up_rest_down());
  const auto controller = with_planted_load<OpenLoopSettings>().make(knowledge);
  const auto currents_mA = play(*controller, knowledge.target.size());
  for (std::size_t k = 101; k < 150; ++k) EXPECT_EQ(currents_mA[k], currents_mA[100]);
  EXPECT_NE(currents_mA[150], currents_mA[149]);
}

TEST(OpenLoop, TakesAStepOfTheTargetToItsNewHeight) {
  const Knowledge knowledge = data_sheets({0.05, 0.05, 0.12, 0.12, 0.12});
  const auto controller = with_planted_load<OpenLoopSettings>().make(knowledge);
  const auto currents_mA = play(*controller, 5);
  const Inverse inverse(planted_calibration(), planted_load_kg, knowledge.valve, false);
  EXPECT_NEAR(currents_mA[4],
              knowledge.valve.current_mA(inverse.pressure_Pa(Branch::contraction, 0.12, 17.0)), 1e-9);
  EXPECT_GT(finding(*controller, "ticks_outside_calibrated_speed"), 0.0);
}

TEST(OpenLoop, CountsTicksOutsideTheCalibratedRange) {
  std::vector<double> target;
  for (int k = 0; k < 100; ++k) target.push_back(0.15 + 0.001 * k);  // calibrated to 0.20
  const Knowledge knowledge = data_sheets(target);
  const auto controller = with_planted_load<OpenLoopSettings>().make(knowledge);
  const auto currents_mA = play(*controller, target.size());
  EXPECT_EQ(finding(*controller, "ticks_outside_calibrated_contraction"), 49.0);
  EXPECT_EQ(currents_mA[99], currents_mA[60]) << "kept at the range's end";
}

TEST(OpenLoop, RefusesALoadItWasNotCalibratedForUnlessToldSo) {
  auto settings = with_planted_load<OpenLoopSettings>();
  settings.assumed_load_kg = 8.87;
  const Knowledge knowledge = data_sheets({0.1});
  try {
    settings.make(knowledge)->rest();
    FAIL() << "8.87 kg is below the lightest calibrated load";
  } catch (const ControllerFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("from 11 to 23.5 kg"), std::string::npos) << failure.what();
    EXPECT_NE(std::string(failure.what()).find("extrapolate_load: true"), std::string::npos);
  }
  settings.extrapolate_load = true;
  const auto controller = settings.make(knowledge);
  controller->rest();
  EXPECT_EQ(finding(*controller, "load_extrapolated"), 1.0);
  EXPECT_EQ(finding(*controller, "load_taken_as_range_end"), 0.0);
}

// Each flag frees its own: the load says nothing about the target, nor the target about the load.
TEST(OpenLoop, ExtrapolatesLoadAndTargetApart) {
  std::vector<double> target;
  for (int k = 0; k < 100; ++k) target.push_back(0.15 + 0.001 * k);  // calibrated to 0.20
  const Knowledge knowledge = data_sheets(target);
  auto settings = with_planted_load<OpenLoopSettings>();
  settings.extrapolate_load = true;
  const auto kept = settings.make(knowledge);
  const auto kept_mA = play(*kept, target.size());
  EXPECT_EQ(kept_mA[99], kept_mA[60]);
  EXPECT_EQ(finding(*kept, "ticks_extrapolated"), 0.0);
  settings.extrapolate_load = false;
  settings.extrapolate_target = true;
  const auto free = settings.make(knowledge);
  EXPECT_GT(play(*free, target.size())[99], kept_mA[99]);
  EXPECT_GE(finding(*free, "ticks_extrapolated"), 49.0);
  settings.assumed_load_kg = 8.87;
  EXPECT_THROW(settings.make(knowledge)->rest(), ControllerFailure);
}

TEST(OpenLoop, TriangleReachesItsCurrentAtTheSpeedOfTheInverse) {
  auto settings = with_planted_load<OpenLoopSettings>();
  settings.mode = OpenLoopMode::triangle;
  settings.to = {0.1, false};
  const Knowledge knowledge = data_sheets({0.1});
  const Inverse inverse(planted_calibration(), planted_load_kg, knowledge.valve, false);
  for (const double speed : {0.25, -0.25}) {
    settings.speed_per_s = speed;
    const Branch branch = speed > 0.0 ? Branch::contraction : Branch::relaxation;
    const Answer answer = inverse(branch, 0.1, speed);
    ASSERT_FALSE(answer.speed_outside);
    const auto controller = settings.make(knowledge);
    EXPECT_EQ(controller->rest().current_mA, 4.0);
    const double arrival_s = finding(*controller, "arrival");
    const double nu = answer.current_speed_mA_per_s;
    const double at_mA = controller->step({0, arrival_s, 0}).current_mA;
    const double before_mA = controller->step({0, arrival_s - 0.1, 0}).current_mA;
    EXPECT_NEAR(at_mA, knowledge.valve.current_mA(answer.pressure_Pa), 1e-9);
    EXPECT_NEAR(at_mA - before_mA, (speed > 0.0 ? 0.1 : -0.1) * nu, 1e-9);
    EXPECT_NEAR(finding(*controller, "current_speed"), nu, 1e-12);
    EXPECT_NEAR(controller->step({0, 1e3, 0}).current_mA, 4.0, 1e-9) << "down again after one triangle";
  }
}

TEST(OpenLoop, WeighsBeforeTheRunAndThenGoesToItsFirstCurrent) {
  auto settings = with_planted_load<OpenLoopSettings>();
  settings.assumed_load_kg.reset();
  const Knowledge knowledge = data_sheets({0.1, 0.1});
  const auto controller = settings.make(knowledge);
  const std::int64_t n = controller->preparation_ticks();
  EXPECT_GT(n, 5 * 111) << "five triangles of 1.33 s, and the way to the first current";
  EXPECT_EQ(controller->rest().current_mA, 4.0);
  // A load that follows the current in a straight line: not its true law, but it moves.
  double current_mA = 4.0;
  for (std::int64_t k = -n; k < 0; ++k)
    current_mA =
        controller->step({k, 0.0, static_cast<std::int64_t>(50.0 + 60.0 * (current_mA - 4.0))}).current_mA;
  EXPECT_EQ(controller->step({0, 0.0, 100}).current_mA, current_mA) << "it is at its first current already";
  EXPECT_GT(finding(*controller, "weighed_load"), 11.0);
  EXPECT_LE(finding(*controller, "believed_load"), 23.5) << "the range's end, if it was weighed beyond";
}

TEST(OpenLoopLimited, NeedsToKnowWhatIsReachable) {
  EXPECT_THROW(with_planted_load<OpenLoopLimitedSettings>().make(data_sheets({0.1})), std::invalid_argument);
}

TEST(OpenLoopLimited, AsksForASlowedTargetEarlier) {
  std::vector<double> target(300, 0.05);
  for (std::size_t k = 100; k < 300; ++k) target[k] = 0.15;
  Knowledge knowledge = data_sheets(target);
  knowledge.reach = even_reach();
  for (auto& load : knowledge.reach.loads) load.rising_lag_s = {0.054, 0.054, 0.054};
  const auto controller = with_planted_load<OpenLoopLimitedSettings>().make(knowledge);
  const auto currents_mA = play(*controller, target.size());
  EXPECT_EQ(currents_mA[94], currents_mA[0]);
  EXPECT_NE(currents_mA[95], currents_mA[0]) << "0.054 s and half a tick are five ticks";
  // 0.5 /s for a step of 0.1: seventeen ticks on the way, and the lag taken off the pressure.
  const Inverse inverse(planted_calibration(), planted_load_kg, knowledge.valve, false);
  const Answer moving = inverse(Branch::contraction, 0.05 + 10.0 * 0.5 * 0.012, 0.5);
  const double lag_Pa = 28125.0 * moving.current_speed_mA_per_s * 0.060;
  EXPECT_NEAR(currents_mA[104], knowledge.valve.current_mA(moving.pressure_Pa - lag_Pa), 1e-6);
  EXPECT_NEAR(finding(*controller, "target_moved_by_at_most"), 0.1 - 0.006, 1e-9);
}

TEST(OpenLoopLimited, OnAReachableTargetWithoutLagIsTheThesissController) {
  const std::vector<double> target = up_rest_down();
  const Knowledge knowledge = without_lag(target);
  const auto limited = play(*with_planted_load<OpenLoopLimitedSettings>().make(knowledge), target.size());
  const auto plain = play(*with_planted_load<OpenLoopSettings>().make(knowledge), target.size());
  for (std::size_t k = 0; k < target.size(); ++k) EXPECT_NEAR(limited[k], plain[k], 1e-6) << "tick " << k;
}

/// Whether a controller without a loop keeps `terms`, which are part of `settings`.
template <class Settings>
void keeps_its_limits(Settings& settings, SafetyTerms& terms) {
  Knowledge knowledge = data_sheets(up_rest_down());
  knowledge.reach = even_reach();
  const auto free = play(*settings.make(knowledge), knowledge.target.size());
  Knowledge cut = knowledge;
  for (double& ratio : cut.target) ratio = std::min(ratio, 0.10);
  const auto to_cut = play(*settings.make(cut), knowledge.target.size());
  terms.highest_target = 0.10;
  EXPECT_EQ(play(*settings.make(knowledge), knowledge.target.size()), to_cut) << Settings::kind;
  EXPECT_NE(free, to_cut);
  terms.largest_current_speed_mA_per_s = 1.0;
  const auto slow = play(*settings.make(knowledge), knowledge.target.size());
  double fastest_mA = 0.0, fastest_free_mA = 0.0;
  for (std::size_t k = 1; k < slow.size(); ++k) {
    fastest_mA = std::max(fastest_mA, std::abs(slow[k] - slow[k - 1]));
    fastest_free_mA = std::max(fastest_free_mA, std::abs(to_cut[k] - to_cut[k - 1]));
  }
  EXPECT_LE(fastest_mA, 1.0 * 0.012 + 1e-12) << Settings::kind;
  EXPECT_GT(fastest_free_mA, 1.0 * 0.012) << Settings::kind << ": there was nothing to limit";
}

TEST(Safety, OpenLoopsKeepTheSpeedOfTheCurrentAndTheHeightOfTheTarget) {
  auto unslowed = with_planted_load<OpenLoopSettings>();
  keeps_its_limits(unslowed, unslowed);
  auto slowed = with_planted_load<OpenLoopLimitedSettings>();
  keeps_its_limits(slowed, slowed);
  StaticInverseSettings blind;
  blind.assumed_load_kg = planted_load_kg;
  keeps_its_limits(blind, blind);
}

/// Weighs a load that follows the current in a straight line; every so often the counter jumps, or it stands
/// still from the beginning.
std::unique_ptr<Controller> weighed(bool jumps, bool stands, const OpenLoopSettings& settings) {
  auto controller = settings.make(data_sheets({0.1, 0.1}));
  double current_mA = controller->rest().current_mA;
  for (std::int64_t k = -controller->preparation_ticks(); k < 0; ++k) {
    const auto counts = static_cast<std::int64_t>(50.0 + 60.0 * (current_mA - 4.0));
    const std::int64_t shown = stands ? 50 : jumps && k % 50 == 0 ? counts + 300 : counts;
    current_mA = controller->step({k, 0.0, shown}).current_mA;
  }
  return controller;
}

TEST(Safety, AWeighingIsNotMisledByCountsThatJumpAndEndsWhereTheyStandStill) {
  auto settings = with_planted_load<OpenLoopSettings>();
  settings.assumed_load_kg.reset();
  settings.extrapolate_load = true;
  const double sound_kg = finding(*weighed(false, false, settings), "weighed_load");
  EXPECT_GT(std::abs(finding(*weighed(true, false, settings), "weighed_load") - sound_kg), 0.08);
  settings.fastest_load_per_s = 5.0;
  const auto controller = weighed(true, false, settings);
  EXPECT_NEAR(finding(*controller, "weighed_load"), sound_kg, 0.02);
  EXPECT_GT(finding(*controller, "ticks_without_counts"), 10.0);
  EXPECT_THROW(weighed(false, true, settings), ControllerFailure);
}

TEST(Weighing, ThatFailedHasNoLoad) {
  auto settings = with_planted_load<OpenLoopSettings>();
  settings.assumed_load_kg.reset();
  const auto controller = settings.make(data_sheets({0.1, 0.1}));
  controller->rest();
  std::string why;
  try {
    for (std::int64_t k = -controller->preparation_ticks(); k < 0; ++k) controller->step({k, 0.0, 50});
  } catch (const ControllerFailure& failure) {
    why = failure.what();
  }
  EXPECT_NE(why.find("weighing failed: in contraction 1 of 5"), std::string::npos) << why;
  for (const Finding& one : controller->findings()) EXPECT_NE(one.unit, "kg") << one.name;
}

TEST(Settings, KnowWhichControllersHaveFeedbackAndWhichACalibration) {
  Settings settings = PidSettings{};
  EXPECT_NE(part_of<PidForm>(settings), nullptr);
  EXPECT_EQ(part_of<CalibrationTerms>(settings), nullptr);
  settings = FeedforwardPidSettings{};
  EXPECT_NE(part_of<PidForm>(settings), nullptr);
  EXPECT_NE(part_of<CalibrationTerms>(settings), nullptr);
  settings = OpenLoopLimitedSettings{};
  EXPECT_EQ(part_of<PidForm>(settings), nullptr);
  EXPECT_NE(part_of<CalibrationTerms>(settings), nullptr);
}

}  // namespace
}  // namespace mckibben::controllers
