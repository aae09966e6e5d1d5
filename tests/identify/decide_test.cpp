// The decision, from tables that are made up.
#include <gtest/gtest.h>

#include <sim/identify/decide.hpp>
#include <sim/identify/decisive.hpp>

namespace mckibben::identify {
namespace {

/// A model whose predictions of four groups are worse than the best one's by so much each.
Scored model(std::vector<std::string> names, double score, double worse, double scatter = 0.1) {
  Scored one{.names = std::move(names), .score = score, .held_out = Eigen::VectorXd(4)};
  one.held_out << -worse - scatter, -worse + scatter, -worse - scatter, -worse + scatter;
  return one;
}

Scored described(double score, double worse) {
  Scored one = model({}, score, worse);
  one.described = true;
  return one;
}

TEST(Decide, TakesTheMostProbableWhereOthersPredictWorse) {
  const Decision d =
      decide({described(-500.0, 100.0), model({}, -300.0, 60.0), model({"muscle_leak"}, 0.0, 0.0)});
  EXPECT_EQ(d.verdict, Verdict::missing_effect);
  EXPECT_EQ(d.chosen, 2U);
  EXPECT_NEAR(d.mass[2], 1.0, 1e-9);
  EXPECT_TRUE(d.rivals.empty());
}

TEST(Decide, HoldsToWhatClosesTheGapWhereAWideErrorPredictsAsWell) {
  Scored leak = model({"muscle_leak"}, 14.0, 0.0), nothing = described(0.0, 4.7);
  nothing.held_out << -16.0, 1.0, -3.0, -1.0;  // 19 +- 16 nats behind
  leak.above_noise = 0.05;
  nothing.above_noise = 1.0;
  EXPECT_EQ(decide({nothing, leak}).verdict, Verdict::missing_effect);
  leak.above_noise = 0.5;
  EXPECT_EQ(decide({nothing, leak}).verdict, Verdict::nothing_missing);
  leak.above_noise = 0.05;
  leak.score = 2.0;  // no strong evidence
  EXPECT_EQ(decide({nothing, leak}).verdict, Verdict::nothing_missing);
}

TEST(Decide, PrefersTheSimplerThatPredictsAsWell) {
  // 16 nats more probable, but only within this load: chance, where disturbances are not of the kind assumed.
  Scored bigger = model({"pressure_threshold"}, 16.0, 0.0), numbers = model({}, 0.0, 0.0);
  numbers.held_out << -40.0, 5.0, 10.0, 8.0;
  const Decision d = decide({bigger, numbers});
  EXPECT_EQ(d.best, 0U);
  EXPECT_EQ(d.verdict, Verdict::recalibrate);
}

TEST(Decide, HoldsWhatTheSheetForbidsForARivalByItsProbabilityAlone) {
  Scored stretched = model({}, -6.8, 0.0, 2.0);  // 4 nats are as much as runs disagree by
  const auto rivals = [&] {
    const std::vector<Scored> table{stretched, model({"viscous_damping"}, 0.0, 0.0)};
    Decision decision = decide(table);
    decision.chosen = 1;
    return does_as_well(table, decision, 0, 1.0);
  };
  EXPECT_TRUE(rivals());
  stretched.off_sheet = 20.0;
  EXPECT_FALSE(rivals());
  stretched.score = -1.0;
  EXPECT_TRUE(rivals());
}

TEST(Decide, DoesNotTakeASimplerOneThatTheSheetForbids) {
  Scored stretched = model({}, -1.0, 0.0);
  stretched.off_sheet = 20.0;
  const Decision d = decide({stretched, model({"viscous_damping"}, 0.0, 0.0)});
  EXPECT_EQ(d.verdict, Verdict::missing_effect);
  EXPECT_FALSE(d.contradicts_sheet);
  ASSERT_EQ(d.rivals.size(), 1U);  // and it is told
  EXPECT_EQ(d.rivals.front(), 0U);
}

TEST(Decide, TakesWhatStandsForAStretchedParameterThoughItIsLessProbable) {
  Scored stretched = model({}, 3.0, 0.0);
  stretched.off_sheet = 20.0;
  const Decision d = decide({stretched, model({"load_label"}, 0.0, 0.0)});
  EXPECT_EQ(d.chosen, 1U);
  EXPECT_FALSE(d.contradicts_sheet);
}

TEST(Decide, TakesARivalThatTheSheetAllowsThoughItPredictsALittleWorse) {
  Scored stretched = model({}, 1.0, 0.0);
  stretched.off_sheet = 6.0;
  const Scored twin = model({"viscous_damping"}, 0.0, 1.0);  // by more than two standard errors
  EXPECT_EQ(decide({stretched, twin}).chosen, 1U);
  EXPECT_EQ(decide({stretched, model({"viscous_damping"}, -30.0, 1.0)}).chosen, 0U);  // no rival
}

TEST(Decide, SaysWhereTheAnswerItselfContradictsTheSheet) {
  Scored only = model({"muscle_leak"}, 0.0, 0.0);
  only.off_sheet = 9.0;
  EXPECT_TRUE(decide({only, model({}, -300.0, 60.0)}).contradicts_sheet);
}

TEST(Decide, GeneralTermsAreUnknownAndNamesBesideThemNoFindings) {
  Scored general = model({"waves"}, 0.0, 0.0);
  general.general = true;
  EXPECT_EQ(decide({general, model({"muscle_leak"}, -80.0, 30.0)}).verdict, Verdict::unknown_effect);
}

TEST(Decide, GeneralTermsAreNeverTheSimplerAnswer) {
  Scored general = model({"smooth"}, -60.0, 0.0);
  general.general = true;
  const Decision d = decide({general, model({"bladder_hysteresis", "gains_differ"}, 0.0, 0.0)});
  EXPECT_EQ(d.chosen, 1U);
}

TEST(Decide, GeneralTermsBeatTheCatalogueByStrongEvidenceOnly) {
  const Scored name = model({"bladder_elasticity"}, 0.0, 6.0);
  for (const double ahead : {1.0, 20.0}) {
    Scored general = model({"bladder_elasticity", "waves"}, ahead, 0.0);
    general.general = true;
    EXPECT_EQ(decide({general, name}).verdict,
              ahead < decisive.strong ? Verdict::missing_effect : Verdict::unknown_effect);
  }
}

TEST(Decide, TakesARivalThatPredictsBetter) {
  Scored general = model({"waves"}, 1.7, 12.9);  // 12.9 nats worse by every load
  general.general = true;
  EXPECT_EQ(decide({general, model({"bladder_elasticity", "gains_differ"}, 0.0, 0.0)}).chosen, 1U);
}

TEST(Decide, NamesNoMoreThanTheMostProbableForPredictingBetter) {
  const Scored more = model({"encoder_backlash"}, -0.9, -1.6);
  EXPECT_EQ(decide({model({}, 0.0, 0.0), more}).chosen, 0U);
  EXPECT_EQ(decide({model({"gauge_error"}, 0.0, 0.0), more}).chosen, 1U);  // as many
}

TEST(Decide, HoldsToAFaultOfOneRunThatSaysNothingOfOthers) {
  Scored zero = described(25.0, 0.0);
  zero.names = zero.faults = {"zeros_differ"};
  EXPECT_EQ(decide({described(0.0, 0.0), zero}).chosen, 1U);
  zero.score = 2.0;  // no strong evidence
  EXPECT_EQ(decide({described(0.0, 0.0), zero}).chosen, 0U);
}

TEST(Decide, AsDescribedIsTheSimplest) {
  EXPECT_EQ(decide({described(-4.0, 0.0), model({}, 0.0, 0.0)}).verdict, Verdict::nothing_missing);
}

TEST(Decide, KnowsQuantilesOfChiSquare) {
  EXPECT_NEAR(chi_square(0.95, 11), 19.675, 0.1);
  EXPECT_NEAR(chi_square(0.95, 3), 7.815, 0.1);
  EXPECT_NEAR(chi_square(0.999, 20), 45.31, 0.2);
}

}  // namespace
}  // namespace mckibben::identify
