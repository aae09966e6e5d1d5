// Every way to each verdict, and the edges between them. Numbers are those of an ordinary data set, moved to
// where it matters.
#include <functional>

#include <gtest/gtest.h>

#include "evidence.hpp"

namespace mckibben::diagnose {
namespace {

using enum Verdict;

struct Way {
  const char* what;
  Evidence evidence;
  std::function<void(Evidence&)> but;
  Verdict verdict;
  Chosen chosen;
  std::vector<Remark> remarks{};
};

using Ways = std::vector<Way>;

Ways to_nothing_missing() {
  using enum Chosen;
  using enum Remark;
  return {
      {"agreement", agreeing(), [](Evidence&) {}, nothing_missing, nominal},
      {"a small gap that nothing closes", agreeing(), [](Evidence& e) { e.nominal_left = 10.0; },
       nothing_missing, nominal},
      {"as much as a disturbance leaves", agreeing(),
       [](Evidence& e) { e.nominal_left = e.recalibrated_left = at.beyond_disturbance; }, nothing_missing,
       nominal},
      {"no gap to speak of, whatever numbers would do", other_numbers(),
       [](Evidence& e) { e.nominal_left = close.nothing_left; }, nothing_missing, nominal},
      {"half of the catalogue would not show",
       agreeing(),
       [](Evidence& e) { e.invisible = 10; },
       nothing_missing,
       nominal,
       {invisible}},
  };
}

Ways to_recalibrate() {
  using enum Chosen;
  using enum Remark;
  return {
      {"other numbers", other_numbers(), [](Evidence&) {}, recalibrate, recalibrated},
      {"other numbers of data that show little",
       other_numbers(),
       [](Evidence& e) { e.invisible = 20; },
       recalibrate,
       recalibrated,
       {invisible}},
      {"other numbers gain too little", other_numbers(),
       [](Evidence& e) { e.recalibration.gained = below(least.gained); }, nothing_missing, nominal},
      {"other numbers close too little", other_numbers(),
       [](Evidence& e) { e.recalibration.share = below(least.share); }, nothing_missing, nominal},
      {"other numbers gain no more than scatter", other_numbers(),
       [](Evidence& e) { e.recalibration.significance = below(least.significance); }, nothing_missing,
       nominal},
      {"scatter as large as a gain that is clear", other_numbers(),
       [](Evidence& e) {
         e.recalibration.significance = 0.1;
         e.recalibration.share = least.clear_share;
       },
       recalibrate, recalibrated},
      {"other numbers gain in half of the runs", other_numbers(),
       [](Evidence& e) { e.recalibration.runs = 4; }, nothing_missing, nominal},
      {"a run far off that other numbers bring near", other_numbers(),
       [](Evidence& e) {
         e.recalibration.share = 0.01;
         e.far_from_nominal = {{"r01", 20.0}};
       },
       recalibrate, recalibrated},
      {"other numbers that leave what a slow disturbance does, in no part more than in others",
       other_numbers(), [](Evidence& e) { e.recalibrated_left = thresholds.near.mean_square() - 1.0; },
       recalibrate, recalibrated},
      {"other numbers that leave as much as is explained", other_numbers(),
       [](Evidence& e) { e.recalibrated_left = most_explained - 1.0; }, recalibrate, recalibrated},
  };
}

Ways to_missing_effect() {
  using enum Chosen;
  return {
      {"an effect", one_name(), [](Evidence&) {}, missing_effect, named},
      {"an effect that closes just enough", one_name(), [](Evidence& e) { e.named_share = at.named_share; },
       missing_effect, named},
      {"an effect that relieves strained numbers", one_name(),
       [](Evidence& e) {
         e.recalibrated_left = below(at.worth_a_law);
         e.named_share = 0.0;
       },
       missing_effect, named},
      {"an effect that leaves as much as is near the floor", one_name(),
       [](Evidence& e) { e.named_left = close.mean_square() - 1.0; }, missing_effect, named},
      {"an effect that leaves more",
       one_name(),
       [](Evidence& e) { e.named_left = above(close.mean_square()) - 1.0; },
       missing_effect,
       named,
       {Remark::more_is_missing}},
      {"an effect that leaves nearly too much",
       one_name(),
       [](Evidence& e) {
         e.named_left = below(at.hopeless);
         e.named_share = at.named_share;
       },
       missing_effect,
       named,
       {Remark::more_is_missing}},
      {"an effect that leaves too much",
       one_name(),
       [](Evidence& e) {
         e.named_left = at.hopeless;
         e.named_share = below(at.nearly_all);
       },
       unknown_effect,
       recalibrated,
       {Remark::not_named}},
      {"an effect that leaves too much of far more",
       one_name(),
       [](Evidence& e) {
         e.named_left = at.hopeless;
         e.named_share = at.nearly_all;
       },
       missing_effect,
       named,
       {Remark::more_is_missing}},
      {"an effect, and a law that is not far better", one_name(),
       [](Evidence& e) {
         e.law_terms = 2;
         e.law_share = 0.99;
         e.law_left = at.law_beyond_names * e.named_left;
       },
       missing_effect, named},
      {"an effect beside one that stands in for something else",
       one_name(),
       [](Evidence& e) { e.stand_ins = 1; },
       missing_effect,
       named,
       {Remark::stands_in}},
      {"an effect beside a fault of all runs", one_name(), [](Evidence& e) { e.common_fault = true; },
       missing_effect, named},
  };
}

Ways to_unknown_effect() {
  using enum Chosen;
  using enum Remark;
  return {
      {"a law", one_law(), [](Evidence&) {}, unknown_effect, law},
      {"a law that closes just too little", one_law(), [](Evidence& e) { e.law_share = at.law_share; },
       unknown_effect, recalibrated},
      {"a law that closes just enough", one_law(), [](Evidence& e) { e.law_share = above(at.law_share); },
       unknown_effect, law},
      {"a law without terms", one_law(), [](Evidence& e) { e.law_terms = 0; }, unknown_effect, recalibrated},
      {"a law that is far better than an effect", one_name(),
       [](Evidence& e) {
         e.law_terms = 1;
         e.law_share = 0.99;
         e.law_left = below(at.law_beyond_names * e.named_left);
       },
       unknown_effect, law},
      {"other numbers that leave more than is explained",
       other_numbers(),
       [](Evidence& e) {
         e.recalibrated_left = above(most_explained) - 1.0;
         e.patterned = true;
       },
       unknown_effect,
       recalibrated,
       {bent_numbers}},
      {"other numbers that would bend further than is allowed",
       other_numbers(),
       [](Evidence& e) { e.bent = true; },
       unknown_effect,
       recalibrated,
       {bent_numbers}},
      {"an effect that closes too little of a gap that numbers leave",
       one_name(),
       [](Evidence& e) {
         e.recalibrated_left = at.beyond_disturbance;
         e.patterned = true;
         e.named_left = 10.0;
         e.named_share = below(at.named_share);
       },
       unknown_effect,
       recalibrated,
       {bent_numbers}},
      {"an effect that stands in for something else",
       one_name(),
       [](Evidence& e) {
         e.names = 0;
         e.stand_ins = 1;
       },
       unknown_effect,
       named,
       {stands_in}},
      {"a law that is better than an effect that stands in", one_name(),
       [](Evidence& e) {
         e.names = 0;
         e.stand_ins = e.law_terms = 1;
         e.law_share = 0.99;
         e.law_left = below(e.named_left);
       },
       unknown_effect, law},
      {"an effect that stands in, and a law that is no better",
       one_name(),
       [](Evidence& e) {
         e.names = 0;
         e.stand_ins = e.law_terms = 1;
         e.law_share = 0.99;
         e.law_left = e.named_left;
       },
       unknown_effect,
       named,
       {stands_in}},
      {"a gap that nothing closes", gap(), [](Evidence&) {}, unknown_effect, recalibrated},
      {"a gap that other numbers make larger", gap(), [](Evidence& e) { e.recalibration.gained = 0.0; },
       unknown_effect, nominal},
      {"just more than a disturbance leaves", gap(),
       [](Evidence& e) { e.recalibrated_left = above(at.beyond_disturbance); }, unknown_effect, recalibrated},
      {"an effect that only the gauge asks for",
       one_name(),
       [](Evidence& e) { e.gauge_misleads = true; },
       unknown_effect,
       recalibrated,
       {gauge_misleads}},
      {"the same, and a law of the motion",
       one_name(),
       [](Evidence& e) {
         e.gauge_misleads = true;
         e.law_terms = 1;
         e.law_share = 0.9;
         e.law_left = 10.0;
       },
       unknown_effect,
       law,
       {gauge_misleads}},
  };
}

Ways to_cannot_tell() {
  using enum Chosen;
  using enum Remark;
  return {
      {"a gap, and a search that was ended", gap(), [](Evidence& e) { e.search_ended = true; }, cannot_tell,
       recalibrated},
      {"agreement, and a search that was ended", agreeing(), [](Evidence& e) { e.search_ended = true; },
       cannot_tell, nominal},
      {"data that cannot be used", one_name(), [](Evidence& e) { e.usable = false; }, cannot_tell, nominal},
      {"more than half of the catalogue would not show",
       agreeing(),
       [](Evidence& e) { e.invisible = 11; },
       cannot_tell,
       nominal,
       {invisible}},
      {"a fault of all runs, and nothing else", agreeing(), [](Evidence& e) { e.common_fault = true; },
       cannot_tell, nominal},
      {"a fault of all runs, and other numbers", other_numbers(), [](Evidence& e) { e.common_fault = true; },
       cannot_tell, nominal},
      {"a run far off whatever the numbers", other_numbers(),
       [](Evidence& e) {
         e.far_from_nominal = e.far_from_recalibrated = {{"r01", 20.0}};
       },
       cannot_tell, nominal},
      {"a run far off where other numbers do not help", agreeing(),
       [](Evidence& e) {
         e.far_from_nominal = {{"r01", 20.0}};
       },
       cannot_tell, nominal},
  };
}

TEST(Decide, EachWayToAVerdict) {
  for (const Ways& ways :
       {to_nothing_missing(), to_recalibrate(), to_missing_effect(), to_unknown_effect(), to_cannot_tell()})
    for (const Way& way : ways) {
      Evidence evidence = way.evidence;
      way.but(evidence);
      const Decision found = decide(evidence, thresholds);
      EXPECT_EQ(found.verdict, way.verdict) << way.what;
      EXPECT_EQ(found.chosen, way.chosen) << way.what;
      EXPECT_EQ(found.remarks, way.remarks) << way.what;
    }
}

TEST(Decide, NamesTheRunsThatNoModelComesNear) {
  Evidence evidence = other_numbers();
  evidence.far_from_nominal = {{"r01", 300.0}, {"r02", 20.0}};
  EXPECT_TRUE(decide(evidence, thresholds).unexplained.empty());
  evidence.far_from_recalibrated = {{"r02", 18.0}};
  ASSERT_EQ(decide(evidence, thresholds).unexplained.size(), 1u);
  EXPECT_EQ(decide(evidence, thresholds).unexplained[0].id, "r02");
  EXPECT_EQ(decide(evidence, thresholds).unexplained[0].left, 18.0);
}

TEST(Decide, WhatLeavesEveryRunFarBefallsTheRigAndNotTheRuns) {
  Evidence evidence = nearly_closed();
  evidence.far_from_nominal = evidence.far_from_recalibrated = {{"r01", 18.0}, {"r02", 20.0}};
  EXPECT_EQ(decide(evidence, thresholds).verdict, unknown_effect);
  EXPECT_EQ(decide(evidence, thresholds).chosen, Chosen::recalibrated);
  EXPECT_TRUE(decide(evidence, thresholds).unexplained.empty());
  evidence.common_fault = true;
  EXPECT_EQ(decide(evidence, thresholds).verdict, cannot_tell);
  EXPECT_EQ(decide(evidence, thresholds).unexplained.size(), 2u);
  evidence.common_fault = false;
  evidence.patterned = false;
  EXPECT_EQ(decide(evidence, thresholds).verdict, cannot_tell);
  evidence = nearly_closed();
  evidence.far_from_nominal = evidence.far_from_recalibrated = {{"r01", 18.0}};
  EXPECT_EQ(decide(evidence, thresholds).verdict, cannot_tell);
}

TEST(Decide, GoesByTheThresholdsThatItIsGiven) {
  Thresholds strict = thresholds;
  strict.decide.beyond_disturbance = 1.0;
  Evidence evidence = agreeing();
  evidence.nominal_left = evidence.recalibrated_left = 2.0;
  EXPECT_EQ(decide(evidence, thresholds).verdict, nothing_missing);
  EXPECT_EQ(decide(evidence, strict).verdict, unknown_effect);
}

TEST(Decide, BelievesALawAfterNumbersThatCloseNearlyAllOnlyIfItExplainsTheRest) {
  Evidence evidence = nearly_closed();
  evidence.law_terms = 1;
  evidence.law_share = 0.9;
  evidence.law_left = most_explained - 1.0;
  EXPECT_EQ(decide(evidence, thresholds).chosen, Chosen::law);
  evidence.law_left += 0.1;
  EXPECT_NE(decide(evidence, thresholds).chosen, Chosen::law);
  evidence.nominal_left = 100.0;  // numbers leave much of the gap: a law need not close all of it
  EXPECT_EQ(decide(evidence, thresholds).chosen, Chosen::law);
}

}  // namespace
}  // namespace mckibben::diagnose
