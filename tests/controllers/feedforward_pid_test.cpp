// PID with a planted calibration ahead of it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <controllers/feedforward_pid.hpp>
#include <controllers/load_in_loop.hpp>
#include <controllers/open_loop.hpp>

#include "planted.hpp"

namespace mckibben::controllers {
namespace {

FeedforwardPidSettings proportional() {
  auto settings = with_planted_load<FeedforwardPidSettings>();
  settings.proportional_mA = 50.0;
  settings.integral_time_s = 0.0;
  settings.derivative_time_s = 0.0;
  return settings;
}

/// Counts of a load that lies so many counts below a target.
std::int64_t counts_at(const Knowledge& knowledge, double target, int below) {
  return static_cast<std::int64_t>(target / knowledge.contraction_per_count) - below;
}

TEST(FeedforwardPid, MovesWithTheMeanOfBothBranchesAgainstHalfOfTheThreadsAndCorrectsWhatIsLeft) {
  const std::vector<double> target = up_rest_down();
  const Knowledge knowledge = without_lag(target);
  EXPECT_THROW(proportional().make(data_sheets(target)), std::invalid_argument) << "no reach";
  EXPECT_THROW(with_planted_load<FeedforwardPidSettings>().make(knowledge), std::invalid_argument)
      << "gains are missing";
  const auto controller = proportional().make(knowledge);
  const double first_mA = controller->rest().current_mA;
  EXPECT_EQ(first_mA, with_planted_load<OpenLoopSettings>().make(knowledge)->rest().current_mA);
  const Inverse inverse(planted_calibration(), planted_load_kg, knowledge.valve, false);
  const auto half_band_mA = [&](double e) {
    return 0.5 * (knowledge.valve.current_mA(inverse.pressure_Pa(Branch::contraction, e, 0.0)) -
                  knowledge.valve.current_mA(inverse.pressure_Pa(Branch::relaxation, e, 0.0)));
  };
  const double first_balanced_mA = balanced_mA(inverse, knowledge.valve, target[0]);
  EXPECT_GT(half_band_mA(0.1), 0.2);
  for (std::size_t k = 0; k < target.size(); ++k) {
    const auto counts = counts_at(knowledge, target[k], k > 50 ? 10 : 0);
    const double y = (static_cast<double>(counts) + 0.5) * knowledge.contraction_per_count;
    const double step = target[k] - target[k == 0 ? 0 : k - 1];
    const double threads_mA = step == 0.0 ? 0.0 : std::copysign(0.5 * half_band_mA(target[k]), step);
    const double base_mA = first_mA + balanced_mA(inverse, knowledge.valve, target[k]) - first_balanced_mA;
    EXPECT_NEAR(controller->step({static_cast<std::int64_t>(k), 0.0, counts}).current_mA,
                std::clamp(base_mA + threads_mA + 50.0 * (target[k] - y), 4.0, 20.0), 1e-6)
        << k;
  }
  EXPECT_EQ(finding(*controller, "ticks_feedforward_faded"), 0.0);
}

TEST(FeedforwardPid, MovesWhenTheLagWillBeOver) {
  const std::vector<double> target = up_rest_down();
  Knowledge knowledge = without_lag(target);
  const auto prompt = play(*proportional().make(knowledge), target.size());
  for (auto& load : knowledge.reach.loads) load.falling_lag_s = {0.114, 0.114, 0.114};
  const auto early = play(*proportional().make(knowledge), target.size());
  for (std::size_t k = 120; k < 195; ++k)  // half the falling lag, 5 ticks; the loop itself looks at no lead
    EXPECT_NEAR(early[k] + 50.0 * (target[k + 5] - target[k]), prompt[k + 5], 1e-9) << k;
}

TEST(FeedforwardPid, ItsDerivativeDoesNotBrakeWhatIsWanted) {
  std::vector<double> target = up_rest_down();
  target.resize(110);
  target.resize(120, 0.05);  // falls back in one tick
  const Knowledge knowledge = without_lag(target);
  auto settings = proportional();
  const auto without = settings.make(knowledge);
  settings.derivative_time_s = 0.04;
  const auto with = settings.make(knowledge);
  for (std::int64_t k = 0; k < 120; ++k) {
    const Reading still{k, 0.0, 100};
    const double w = (knowledge.target_at(k) - knowledge.target_at(k - 1)) / knowledge.tick_s;
    const double difference_mA = with->step(still).current_mA - without->step(still).current_mA;
    EXPECT_NEAR(difference_mA, 50.0 * 0.04 * std::max(w, -0.25), 1e-9) << k << ": the rig falls at 0.25 /s";
  }
}

TEST(FeedforwardPid, FollowsNoTargetAboveTheHighest) {
  const Knowledge knowledge = without_lag(up_rest_down());
  Knowledge cut = knowledge;
  for (double& ratio : cut.target) ratio = std::min(ratio, 0.10);
  auto settings = proportional();
  const auto to_cut = play(*settings.make(cut), cut.target.size());
  EXPECT_NE(play(*settings.make(knowledge), cut.target.size()), to_cut);
  settings.highest_target = 0.10;
  EXPECT_EQ(play(*settings.make(knowledge), cut.target.size()), to_cut);
}

/// The load that is found from counts that lie on the target, but for one tick.
double found_kg(const FeedforwardPidSettings& settings, int jump) {
  const Knowledge knowledge = without_lag(up_rest_down());
  const auto controller = settings.make(knowledge);
  controller->rest();
  for (std::int64_t k = 0; k < 150; ++k)
    controller->step({k, 0.0, counts_at(knowledge, knowledge.target_at(k), 20) + (k == 64 ? jump : 0)});
  return finding(*controller, "found_load");
}

TEST(FeedforwardPid, CountsThatJumpDoNotMisleadItAboutTheLoad) {
  auto settings = proportional();
  settings.assumed_load_kg.reset();
  settings.proportional_mA = 200.0;
  const double sound_kg = found_kg(settings, 0);
  EXPECT_GT(std::abs(found_kg(settings, 100) - sound_kg), 0.02 * sound_kg);
  settings.fastest_load_per_s = 1.0;
  EXPECT_NEAR(found_kg(settings, 100), sound_kg, 0.01 * sound_kg);
}

TEST(FeedforwardPid, FadesOutWhereTheModelEnds) {
  std::vector<double> target;
  for (int k = 0; k < 100; ++k) target.push_back(0.15 + 0.001 * k);  // calibrated to 0.20, believed to 0.182
  const Knowledge knowledge = without_lag(target);
  const auto controller = proportional().make(knowledge);
  controller->rest();
  std::vector<double> bases_mA;
  for (std::size_t k = 0; k < target.size(); ++k) {
    const auto counts = counts_at(knowledge, target[k], 0);
    const double y = (static_cast<double>(counts) + 0.5) * knowledge.contraction_per_count;
    bases_mA.push_back(controller->step({static_cast<std::int64_t>(k), 0.0, counts}).current_mA -
                       50.0 * (target[k] - y));
  }
  const auto step_mA = [&](std::size_t k) { return bases_mA[k] - bases_mA[k - 1]; };
  EXPECT_GT(step_mA(31), 0.0);
  EXPECT_LT(step_mA(45), 0.5 * step_mA(31));
  EXPECT_NEAR(step_mA(60), 0.0, 1e-9);
  EXPECT_NEAR(finding(*controller, "ticks_feedforward_faded"), 67.0, 1.0);
}

TEST(FeedforwardPid, IsALoopAloneUnderALoadThatWasNotCalibrated) {
  const std::vector<double> target = up_rest_down();
  const Knowledge knowledge = without_lag(target);
  auto settings = proportional();
  settings.assumed_load_kg = 8.87;
  settings.extrapolate_load = true;
  const auto controller = settings.make(knowledge);
  const double first_mA = controller->rest().current_mA;
  for (std::size_t k = 0; k < target.size(); ++k) {
    const auto counts = counts_at(knowledge, target[k], 0);
    const double y = (static_cast<double>(counts) + 0.5) * knowledge.contraction_per_count;
    EXPECT_NEAR(controller->step({static_cast<std::int64_t>(k), 0.0, counts}).current_mA,
                std::max(first_mA + 50.0 * (target[k] - y), 4.0), 1e-9);
  }
  EXPECT_GT(finding(*controller, "ticks_feedforward_faded"), 190.0);
}

/// What a loop would give that holds the planted load on the target, tick by tick.
double held_mA(const Inverse& inverse, const Knowledge& knowledge, std::int64_t tick) {
  const double e = knowledge.target_at(tick),
               w = (e - knowledge.target_at(std::max<std::int64_t>(tick - 1, 0))) / knowledge.tick_s;
  if (w == 0.0) return balanced_mA(inverse, knowledge.valve, e);
  return knowledge.valve.current_mA(
      inverse(w > 0.0 ? Branch::contraction : Branch::relaxation, e, w).pressure_Pa);
}

TEST(LoadInLoop, IsFoundOnceAStretchOfTheTargetIsOver) {
  const Knowledge knowledge = data_sheets(up_rest_down());
  const Inverse inverse(planted_calibration(), planted_load_kg, knowledge.valve, false);
  LoadInLoop load(planted_calibration(), knowledge), limited(planted_calibration(), knowledge);
  for (std::int64_t k = 0; k < 249; ++k) {
    const auto counts = counts_at(knowledge, knowledge.target_at(k), 0);
    load.see(k, counts, held_mA(inverse, knowledge, k), true);
    limited.see(k, counts, held_mA(inverse, knowledge, k), false);
    if (k == 99) {
      EXPECT_FALSE(load.load_kg()) << "the target still rises";
    }
    if (k == 101 || k == 151) {  // after the rise, after the rest
      EXPECT_NEAR(load.load_kg().value_or(0.0), planted_load_kg, 0.01 * planted_load_kg) << k;
    }
  }
  EXPECT_FALSE(limited.load_kg()) << "an output at its limit says nothing";
}

TEST(FeedforwardPid, BeginsAsALoopAndFeedsForwardOnceItKnowsTheLoad) {
  const std::vector<double> target = up_rest_down();
  const Knowledge knowledge = without_lag(target);
  auto settings = proportional();
  settings.proportional_mA = 500.0;
  settings.assumed_load_kg.reset();
  const auto controller = settings.make(knowledge);
  EXPECT_EQ(controller->preparation_ticks(), 0);
  EXPECT_EQ(controller->rest().current_mA, 4.0);
  const Inverse inverse(planted_calibration(), planted_load_kg, knowledge.valve, false);
  // The load hangs where the loop's current is what it takes.
  std::vector<double> bases_mA{4.0};
  for (std::size_t k = 0; k < target.size(); ++k) {
    const auto tick = static_cast<std::int64_t>(k);
    const double y = target[k] - (held_mA(inverse, knowledge, tick) - bases_mA.back()) / 500.0;
    const auto counts = static_cast<std::int64_t>(std::floor(y / knowledge.contraction_per_count));
    const double read = (static_cast<double>(counts) + 0.5) * knowledge.contraction_per_count;
    bases_mA.push_back(controller->step({tick, 0.0, counts}).current_mA - 500.0 * (target[k] - read));
  }
  EXPECT_NEAR(bases_mA[100], 4.0, 1e-9) << "it did not know the load before the first rise was over";
  EXPECT_NEAR(bases_mA[150], 4.0, 1e-9) << "at rest nothing is fed forward";
  EXPECT_LT(bases_mA[200], 3.9);
  EXPECT_NEAR(finding(*controller, "found_load"), planted_load_kg, 0.1 * planted_load_kg);
  EXPECT_GT(finding(*controller, "ticks_feedforward_faded"), 98.0);
}

}  // namespace
}  // namespace mckibben::controllers
