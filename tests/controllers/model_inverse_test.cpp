// Looking ahead, weighing by a rise, and the two controllers that do so, against a rig solved by hand.
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <controllers/look_ahead.hpp>
#include <controllers/model_inverse.hpp>
#include <controllers/rise_weighing.hpp>

#include "believed.hpp"

namespace mckibben::controllers {
namespace {

constexpr double one_count = 4e-4;
constexpr std::size_t run_ticks = 600;

Knowledge knowledge() {
  Knowledge known;
  known.contraction_per_count = one_count;
  known.tick_s = 0.012;
  known.largest_current_mA = 20.0;
  known.target.assign(run_ticks, 0.02);
  for (std::size_t k = 100; k < run_ticks; ++k) {
    const double turns = static_cast<double>(k - 100) / 250.0;
    known.target[k] = 0.02 + 0.06 * std::pow(std::sin(3.14159265 * turns), 2);
  }
  known.model = {0.0075, 0.3, 0.4, 1.0, false};
  known.valve = {4.0, 20.0, 0.5e5, 5e5};
  return known;
}

std::int64_t counted(const RigModel& rig) {
  return static_cast<std::int64_t>(std::floor(rig.shown_ratio() / one_count));
}

/// Root mean square error of a controller on a rig, from tick 0 on.
double rmse(Controller& controller, RigModel& rig, const Knowledge& known) {
  double squares = 0.0;
  for (std::int64_t k = -controller.preparation_ticks(); k < static_cast<std::int64_t>(run_ticks); ++k) {
    if (k >= 0) squares += std::pow(rig.contraction_ratio() - known.target_at(k), 2);
    rig.step({rig.given_mA(controller.step({k, static_cast<double>(k) * 0.012, counted(rig)}).current_mA)},
             1);
  }
  return std::sqrt(squares / static_cast<double>(run_ticks));
}

TEST(LookAhead, FindsTheCurrentThatEndsOnTheTargetAndLeavesTheModelAsItWas) {
  Believed rig({}, 10.0, 10.0);
  LookAhead look(16.0, 6);
  const double before = rig.contraction_ratio();
  const double current_mA = look.current_mA(rig, 0.1, 10.0, {4.0, 20.0});
  EXPECT_EQ(rig.contraction_ratio(), before);
  for (int i = 0; i < 6; ++i) rig.step(current_mA);
  EXPECT_NEAR(rig.contraction_ratio(), 0.1, 2e-5);
}

TEST(LookAhead, StaysWithinItsLimitsAndKeepsTheCurrentOfALoadThatIsThere) {
  Believed rig({}, 10.0, 10.0);
  LookAhead look(16.0, 2);
  double current_mA = 10.0;
  for (int i = 0; i < 30; ++i) {
    current_mA = look.current_mA(rig, 0.19, current_mA, {4.0, 11.0});
    EXPECT_LE(current_mA, 11.0);
    rig.step(current_mA);
  }
  EXPECT_EQ(current_mA, 11.0);
  EXPECT_EQ(look.current_mA(rig, rig.contraction_ratio(), 11.0, {4.0, 11.0}), 11.0);
}

TEST(RiseWeighing, TakesTheLoadWithWhichTheModelRisesAsTheCountsDid) {
  const Knowledge known = knowledge();
  for (const double load_kg : {3.0, 11.0, 20.0})
    for (const int delay : {0, 4}) {
      RiseWeighing weighing(1.0, delay, known);
      Believed rig({}, load_kg, weighing.rest_mA());
      Delayed<std::int64_t> late(delay);
      while (!weighing.done()) rig.step(rig.given_mA(weighing.step_mA(late(counted(rig)))));
      const auto model = weighing.weighed(believed({}));
      EXPECT_NEAR(weighing.load_kg(), load_kg, 0.02 * load_kg);
      EXPECT_LT(weighing.misfit(), one_count);
      EXPECT_NEAR(model->contraction_ratio(), rig.contraction_ratio(), 2.0 * one_count);
      EXPECT_LT(rig.contraction_ratio(), 0.03) << "it is lifted to where the target begins, and no further";
    }
}

TEST(RiseWeighing, GivesUpOnALoadThatDoesNotRise) {
  RiseWeighing weighing(1.0, 0, knowledge());
  while (!weighing.done()) EXPECT_LE(weighing.step_mA(3), 20.0);
  try {
    weighing.weighed(believed({}));
    FAIL();
  } catch (const ControllerFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("up to 20 mA the load rose by 3 counts"), std::string::npos)
        << failure.what();
  }
}

TEST(RiseWeighing, GivesUpOnAModelThatNeverRises) {
  RiseWeighing weighing(1.0, 0, knowledge());
  std::int64_t counts = 0;
  while (!weighing.done()) weighing.step_mA(counts++);
  EXPECT_THROW(weighing.weighed(believed({.per_mA = 0.0})), ControllerFailure);
}

TEST(ModelInverse, FollowsWithoutACountAfterTheWeighing) {
  const Knowledge known = knowledge();
  ModelInverseSettings settings;
  settings.model = believed({.play = 0.01});
  const auto controller = settings.make(known);
  Believed rig({.play = 0.01}, 12.0, 4.0);
  EXPECT_LT(rmse(*controller, rig, known), 0.003);
  EXPECT_NEAR(value_of(controller->findings(), "weighed_load"), 12.0, 0.2);

  std::vector<double> currents_mA[2];
  for (int jump : {0, 1}) {
    const auto one = settings.make(known);
    Believed lifted({.play = 0.01}, 12.0, 4.0);
    for (std::int64_t k = -one->preparation_ticks(); k < 300; ++k) {
      const double current_mA = one->step({k, 0.0, counted(lifted) + (k > 0 ? 500 * jump : 0)}).current_mA;
      if (k >= 0) currents_mA[jump].push_back(current_mA);
      lifted.step(lifted.given_mA(current_mA));
    }
  }
  EXPECT_EQ(currents_mA[0], currents_mA[1]);
}

TEST(ModelInverse, WithAnAssumedLoadWeighsNothing) {
  ModelInverseSettings settings;
  settings.model = believed({});
  settings.assumed_load_kg = 12.0;
  const Knowledge known = knowledge();
  const auto controller = settings.make(known);
  EXPECT_LT(controller->preparation_ticks(), 100);
  Believed rig({}, 12.0, 4.0);
  EXPECT_LT(rmse(*controller, rig, known), 0.003);
}

// `control` has a few ticks for each answer but the first.
TEST(ModelInverse, PlansBeforeTimeCountsWhereTheLoadIsTold) {
  const auto of_rest_and_step = [](auto settings) {
    int copies = 0;
    settings.assumed_load_kg = 12.0;
    settings.model = [&](double load_kg, const Command& rest) {
      return std::make_unique<Believed>(Laws{.copies = &copies}, load_kg, rest.current_mA);
    };
    const auto controller = settings.make(knowledge());
    EXPECT_EQ(controller->rest().current_mA, 4.0);
    const int in_rest = std::exchange(copies, 0);
    controller->step({-controller->preparation_ticks(), 0.0, 0});
    return std::pair(in_rest, copies);
  };
  EXPECT_EQ(of_rest_and_step(ModelInverseSettings{}), std::pair(1, 0));
  EXPECT_EQ(of_rest_and_step(ModelInverseFeedbackSettings{}), std::pair(1, 0));
}

TEST(ModelInverse, NeedsAModel) {
  EXPECT_THROW(ModelInverseSettings{}.make(knowledge()), std::invalid_argument);
  EXPECT_THROW(ModelInverseFeedbackSettings{}.make(knowledge()), std::invalid_argument);
}

TEST(ModelInverse, SaysThatItsModelCannotBeCarriedOn) {
  ModelInverseSettings settings;
  settings.assumed_load_kg = 12.0;
  settings.model = [](double, const Command&) -> std::unique_ptr<RigModel> { throw ModelFailure("no root"); };
  const auto controller = settings.make(knowledge());
  EXPECT_THROW(controller->step({-1, 0.0, 0}), ControllerFailure);
}

// What a model does not know: another height for each mA, and another play.
TEST(ModelInverseFeedback, MakesUpForWhatTheModelDoesNotKnowWhateverTheDelay) {
  const Knowledge known = knowledge();
  const Laws truth{.per_mA = 0.024, .play = 0.015};
  ModelInverseSettings open;
  open.model = believed({.play = 0.01});
  Believed alone(truth, 12.0, 4.0);
  const double without = rmse(*open.make(known), alone, known);
  for (const int delay : {0, 2, 5}) {
    ModelInverseFeedbackSettings settings;
    settings.model = believed({.play = 0.01});
    settings.feedback_delay_ticks = delay;
    Believed rig(truth, 12.0, 4.0);
    EXPECT_LT(rmse(*settings.make(known), rig, known), 0.5 * without) << delay;
  }
}

TEST(ModelInverseFeedback, IsTheInverseWhereTheModelIsTrue) {
  const Knowledge known = knowledge();
  ModelInverseFeedbackSettings settings;
  settings.model = believed({});
  settings.assumed_load_kg = 12.0;
  settings.feedback_delay_ticks = 5;
  ModelInverseSettings open;
  open.model = believed({});
  open.assumed_load_kg = 12.0;
  Believed rig({}, 12.0, 4.0), open_rig({}, 12.0, 4.0);
  EXPECT_EQ(rmse(*settings.make(known), rig, known), rmse(*open.make(known), open_rig, known));
}

}  // namespace
}  // namespace mckibben::controllers
