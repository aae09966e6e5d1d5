// Numbers that depart further than they are stated to, in place of names.
#include <limits>

#include <gtest/gtest.h>

#include <sim/diagnose/further.hpp>
#include <sim/diagnose/search.hpp>

#include "strained.hpp"

namespace mckibben::diagnose {
namespace {

const Strained& rubbing() {
  static const Strained runs = [] {
    plant::Rig truth;
    truth.friction.scale = 1.46;
    return Strained(truth);
  }();
  return runs;
}

const Parameter& friction(const Model& model) {
  for (const Parameter& p : model.free)
    if (p.path == "friction.scale") return p;
  throw std::logic_error("friction is not free");
}

TEST(Further, WidensPriorsAndBoundsOfNumbersAndKeepsWhatStandsWhereItDid) {
  const Strained& runs = rubbing();
  const Parameter& stated = friction(runs.recalibrated.fitted.model);
  const Fitted wider = with_wider_numbers(runs.recalibrated.fitted, *runs.at);
  const Parameter& p = friction(wider.model);
  EXPECT_NEAR(p.highest, 1.5, 1e-12);
  EXPECT_NEAR(p.lowest, 0.5, 1e-12);
  EXPECT_NEAR(stated.highest, 1.3, 1e-12);
  EXPECT_NEAR(p.deviations(1.46), 4.6, 1e-9);  // of what is stated
  EXPECT_NEAR(p.scaled(1.46), 4.6 * 0.6, 1e-9);
  const Fitted twice = with_wider_numbers(wider, *runs.at);
  EXPECT_EQ(friction(twice.model).highest, p.highest);
  Eigen::Index j = 0;
  while (wider.model.free[static_cast<std::size_t>(j)].path != "friction.scale") ++j;
  EXPECT_TRUE(wider.columns.col(j).isApprox(runs.recalibrated.fitted.columns.col(j) * (5.0 / 3.0)));
}

TEST(Further, LeavesNumbersThatAreNotKnownAtAllAsTheyAre) {
  Case c = *rubbing().at;
  Rig nominal = c.nominal;
  nominal.spreads["friction.scale"] = std::numeric_limits<double>::infinity();
  const Case unknown{c.experiment, nominal, c.split, c.inflation, {}};
  EXPECT_EQ(friction(with_wider_numbers(rubbing().recalibrated.fitted, unknown).model).widened, 1.0);
}

TEST(Further, ExpectsOfNumbersWhatStraightLinesReach) {
  Fitted fitted;
  fitted.model.free = {{.path = "friction.scale", .origin = 1.0, .scale = 0.1, .has_prior = true}};
  fitted.model.rig.friction.scale = 1.1;  // one deviation off
  fitted.residuals = Eigen::VectorXd::Constant(4, 6.0);
  fitted.columns = Eigen::MatrixXd::Constant(4, 1, 2.0);
  // Of s more deviations: 4 (6 - 2 s)^2 / 4 + (1 + s)^2, least at s = 11/5.
  EXPECT_NEAR(least_by_lines(fitted, 4.0), 1.6 * 1.6 + 3.2 * 3.2, 1e-6);
}

TEST(Further, GivesUpAnAimThatStraightLinesMissByFar) {
  Fitted fitted;
  fitted.residuals = Eigen::VectorXd::Constant(4, 60.0);
  fitted.columns = Eigen::MatrixXd::Zero(4, 0);  // nothing moves them
  fitted.cost = 3600.0;
  EXPECT_TRUE(out_of_reach(0.0, fitted, 4.0));
  EXPECT_FALSE(out_of_reach(3590.0, fitted, 4.0));
}

TEST(Further, PrefersANumberFarOffToTheEffectThatImitatesIt) {
  const Strained& runs = rubbing();
  const Contender named = runs.named("speed_dependent_friction");
  ASSERT_GT(named.held_out.size(), 0);
  const auto numbers = numbers_as_good(*runs.at, runs.bases(), named);
  ASSERT_TRUE(numbers.has_value());
  EXPECT_NEAR(numbers->fitted.model.rig.friction.scale, 1.46, 0.06);

  Naming naming;
  naming.best = named;
  naming.effects = {{.name = "speed_dependent_friction", .variant = ""}};
  naming.ranking = {{.name = "speed_dependent_friction", .outcome = "taken: the best fit"}};
  naming.ranking.front().variant = named.fitted.model.effects.front().variant;
  prefer_numbers(*runs.at, runs.bases(), naming, [](const Doing&) {});
  EXPECT_TRUE(naming.effects.empty());
  EXPECT_TRUE(naming.best.fitted.model.effects.empty());
  EXPECT_TRUE(
      naming.ranking.front().outcome.starts_with("given up: other numbers do as well: friction.scale +"))
      << naming.ranking.front().outcome;
  ASSERT_EQ(naming.doubts.size(), 1u);
  EXPECT_EQ(naming.doubts.front().words(),
            (std::vector<std::string>{"other numbers", "speed_dependent_friction"}));
}

TEST(Further, KeepsAnEffectThatNumbersCannotImitate) {
  plant::Rig truth;
  truth.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 2e-10;
  const Strained runs(truth);
  const Contender named = runs.named("muscle_leak");
  EXPECT_FALSE(numbers_as_good(*runs.at, runs.bases(), named).has_value());
  Naming naming;
  naming.best = named;
  naming.effects = {{.name = "muscle_leak", .variant = ""}};
  prefer_numbers(*runs.at, runs.bases(), naming, [](const Doing&) {});
  EXPECT_EQ(naming.effects.size(), 1u);
}

}  // namespace
}  // namespace mckibben::diagnose
