// Sets of effects from their projected scores alone.
#include <random>

#include <gtest/gtest.h>

#include <sim/diagnose/subsets.hpp>

namespace mckibben::diagnose {
namespace {

/// A score as a screening makes it: what a little of the effect changes, against a gap.
Score score_of(const char* effect, Eigen::VectorXd column, const Eigen::VectorXd& gap) {
  Score score;
  score.candidate.effect = effect;
  score.candidate.typical = 1.0;
  score.amplitude = column.dot(gap) / column.squaredNorm();
  score.column = std::move(column);
  return score;
}

Eigen::VectorXd noise(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd values(60);
  for (double& value : values) value = normal(random);
  return values;
}

std::vector<std::string> names(const Subset& subset) {
  std::vector<std::string> list;
  for (const Score& score : subset.members) list.push_back(score.candidate.effect);
  return list;
}

/// Three effects make a gap; a fourth looks like their sum and is the best by itself.
struct Deceived : testing::Test {
  std::mt19937_64 random{5};
  const Eigen::VectorXd a = noise(random), b = noise(random), c = noise(random);
  const Eigen::VectorXd gap = 20.0 * a + 12.0 * b + 9.0 * c;
  const Eigen::VectorXd stand_in = a + 0.6 * b + 0.45 * c + 0.2 * noise(random);

  std::vector<Score> scores() const {
    return {score_of("stand_in", stand_in, gap), score_of("a", a, gap), score_of("b", b, gap),
            score_of("c", c, gap)};
  }
};

TEST_F(Deceived, TheSetThatMakesTheGapComesFirst) {
  const auto found = best_subsets(scores());
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(names(found.front()), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_NEAR(found.front().drop, gap.squaredNorm(), 1e-6 * gap.squaredNorm());
  EXPECT_NEAR(found.front().members[1].amplitude, 12.0, 1e-6);
}

TEST_F(Deceived, ASignThatItsLawForbidsTakesPartInNone) {
  auto list = scores();
  list[1] = score_of("a", -a, gap);
  for (const Subset& subset : best_subsets(list))
    for (const Score& score : subset.members) EXPECT_GT(score.amplitude, 0.0) << score.candidate.effect;
  list[1].candidate.either_sign = true;
  EXPECT_EQ(names(best_subsets(list).front()), (std::vector<std::string>{"a", "b", "c"}));
}

TEST_F(Deceived, NoSetHasAMemberThatTheOthersDoNotNeed) {
  auto list = scores();
  list.push_back(score_of("idle", noise(random), gap));
  for (const Subset& subset : best_subsets(list))
    for (const auto& name : names(subset)) EXPECT_NE(name, "idle");
}

TEST_F(Deceived, TwoLawsOfOneEffectAreNotTwoEffects) {
  auto list = scores();
  list[2].candidate.effect = "a";
  for (const Subset& subset : best_subsets(list)) {
    const auto members = names(subset);
    EXPECT_LE(std::count(members.begin(), members.end(), "a"), 1);
  }
}

TEST_F(Deceived, TwinsAreNoPair) {
  const auto list = std::vector{score_of("a", a, gap), score_of("twin", a, gap)};
  EXPECT_TRUE(best_subsets(list).empty());
}

}  // namespace
}  // namespace mckibben::diagnose
