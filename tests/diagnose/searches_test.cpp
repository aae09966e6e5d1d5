// Which searches the evidence asks for: a law of the force, a diagnosis without the gauge.
#include <gtest/gtest.h>

#include "evidence.hpp"

namespace mckibben::diagnose {
namespace {

using enum Verdict;

TEST(Decide, SearchesForALawWhereEnoughIsLeft) {
  Evidence evidence = gap();
  const auto asked = [&](double nominal_left, double left) {
    evidence.nominal_left = nominal_left;
    evidence.recalibrated_left = left;
    return asks_for_law(evidence, thresholds);
  };
  EXPECT_FALSE(asked(1.0, at.worth_a_law));
  EXPECT_TRUE(asked(1.0, above(at.worth_a_law)));
  EXPECT_FALSE(asked(100.0, 100.0 * at.worth_a_law_share));
  EXPECT_TRUE(asked(100.0, above(100.0 * at.worth_a_law_share)));
  evidence = one_name();  // by what the names leave, unless only the gauge asks for them
  EXPECT_FALSE(asks_for_law(evidence, thresholds));
  evidence.gauge_misleads = true;
  EXPECT_TRUE(asks_for_law(evidence, thresholds));
}

TEST(Decide, SearchesForALawWhereNumbersThatCloseNearlyAllLeaveAPattern) {
  Evidence evidence = nearly_closed();
  EXPECT_TRUE(asks_for_law(evidence, thresholds));
  evidence.patterned = false;  // a slow disturbance does
  EXPECT_FALSE(asks_for_law(evidence, thresholds));
  evidence = nearly_closed();
  evidence.recalibrated_left = most_explained - 1.0;
  EXPECT_FALSE(asks_for_law(evidence, thresholds));
  evidence.bent = true;
  EXPECT_TRUE(asks_for_law(evidence, thresholds));
}

TEST(Decide, SearchesForALawWhereNamesLeaveMuchHoweverFarTheDescribedRigIs) {
  Evidence evidence = one_name();
  evidence.nominal_left = 5e4;
  evidence.named_left = close.mean_square() - 1.0;
  EXPECT_FALSE(asks_for_law(evidence, thresholds));
  evidence.named_left = above(close.mean_square());
  EXPECT_TRUE(asks_for_law(evidence, thresholds));
}

TEST(Decide, SuspectsTheGaugeWhereTheMotionIsNotMet) {
  EXPECT_FALSE(gauge_is_suspect(below(at.contradicted), thresholds));
  EXPECT_TRUE(gauge_is_suspect(at.contradicted, thresholds));
  EXPECT_FALSE(gauge_is_suspect(std::nan(""), thresholds));  // nothing was compared
  const double most = 8.0 * at.without_gauge;
  EXPECT_TRUE(better_without_gauge(8.0, most, nothing_missing, false, thresholds));
  EXPECT_TRUE(better_without_gauge(8.0, most, missing_effect, false, thresholds));
  EXPECT_FALSE(better_without_gauge(8.0, above(most), missing_effect, false, thresholds));
  EXPECT_FALSE(better_without_gauge(8.0, 0.0, cannot_tell, false, thresholds));
  EXPECT_FALSE(better_without_gauge(8.0, 0.0, unknown_effect, true, thresholds));
}

}  // namespace
}  // namespace mckibben::diagnose
