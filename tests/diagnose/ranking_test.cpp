// What is called taken is what is named.
#include <gtest/gtest.h>

#include <sim/diagnose/ranking.hpp>

namespace mckibben::diagnose {
namespace {

std::vector<Ranked> two_taken() {
  return {{.name = "muscle_leak", .outcome = "taken: the best fit, and better on runs held out"},
          {.name = "valve_lag", .round = 2, .outcome = "fits less well"},
          {.name = "bladder_elasticity",
           .variant = "linear",
           .round = 2,
           .outcome = "taken: the best fit, and better on runs held out"}};
}

TEST(Ranking, SaysWhyWhatWasTakenIsNoMore) {
  auto ranking = two_taken();
  Candidate gone;
  gone.effect = "bladder_elasticity";
  gone.variant = "strain_limit";
  give_up(ranking, gone, "not needed");
  EXPECT_TRUE(ranking[2].outcome.starts_with("taken"));  // another law of that name
  gone.variant = "linear";
  give_up(ranking, gone, "not needed");
  EXPECT_EQ(ranking[2].outcome, "given up: not needed");
  EXPECT_TRUE(ranking[0].outcome.starts_with("taken"));
}

TEST(Ranking, CallsNothingTakenWhereNothingIsNamed) {
  auto ranking = two_taken();
  disown(ranking);
  for (const Ranked& one : ranking) EXPECT_FALSE(one.outcome.starts_with("taken")) << one.name;
  EXPECT_EQ(ranking[1].outcome, "fits less well");
}

}  // namespace
}  // namespace mckibben::diagnose
