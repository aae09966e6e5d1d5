// The verdict in words.
#include <gtest/gtest.h>

#include <sim/data/amount.hpp>
#include <sim/diagnose/story.hpp>

namespace mckibben::diagnose {
namespace {

/// A leak for which these runs speak, of nine.
std::string because_of(std::vector<std::string> by, std::vector<std::string> against) {
  Diagnosis d;
  d.verdict = Verdict::missing_effect;
  NamedEffect leak{.name = "muscle_leak", .variant = ""};
  leak.support.runs = 9;
  leak.support.by = std::move(by);
  leak.support.against = std::move(against);
  d.effects = {leak};
  return because(d);
}

TEST(Story, NamesTheRunsThatSpeakForANameAndAgainstIt) {
  const auto says = [](const std::string& text, const std::string& words) {
    return text.find("atmosphere). " + words + " On runs that") != std::string::npos;
  };
  const auto all = because_of({"a", "b", "c", "d", "e", "f", "g", "h", "i"}, {});
  EXPECT_TRUE(says(all, "All 9 runs speak for muscle_leak.")) << all;
  const auto most = because_of({"a", "b", "c", "d", "e", "f", "g"}, {"h"});
  EXPECT_TRUE(says(most, "7 of 9 runs speak for muscle_leak, run h against it.")) << most;
  const auto few = because_of({"a", "b"}, {"c", "d"});
  EXPECT_TRUE(says(few, "Runs a, b speak for muscle_leak, runs c, d against it.")) << few;
  const auto one = because_of({"a"}, {});
  EXPECT_TRUE(says(one, "Run a speaks for muscle_leak.")) << one;
  const auto none = because_of({}, {});
  EXPECT_TRUE(says(none, "No run alone separates muscle_leak from other values of the rig's parameters."))
      << none;
  const auto against = because_of({}, {"c"});
  EXPECT_TRUE(says(against, "No single run speaks for muscle_leak, run c against it.")) << against;
}

TEST(Story, NamesFaultsOfTheBenchFirstAndSaysWhereASearchWasEnded) {
  Diagnosis d;
  d.verdict = Verdict::recalibrate;
  d.bench = {{.name = "loads_differ",
              .runs = {"r05"},
              .size = {.name = "", .unit = "", .value = -2.8, .low = -2.9, .high = -2.7},
              .write = "load: 11.1 kg",
              .words = "the load of run r05 is 2.8 kg less than written"}};
  const std::string whole = because(d);
  EXPECT_TRUE(
      whole.starts_with("The load of run r05 is 2.8 kg less than written (in the data set: load: 11.1 "
                        "kg). No effect is missing"))
      << whole;
  d.ended = Ended::by_work;
  d.not_done = {"effects"};
  const std::string cut = because(d);
  EXPECT_TRUE(cut.starts_with("So far: The load of run r05 is 2.8 kg less than written")) << cut;
  EXPECT_TRUE(
      cut.ends_with("The search was ended after as many simulations as it may make before it was "
                    "through; not done to the end: effects."))
      << cut;
}

TEST(Story, BeginsWithNoFaultWhoseIntervalHoldsNothing) {
  Diagnosis d;
  d.verdict = Verdict::recalibrate;
  d.bench = {{.name = "zeros_differ",
              .runs = {"r2"},
              .size = {.name = "", .unit = "", .value = 1e-4, .low = -1e-4, .high = 3e-4},
              .words = "the zero of run r2 is 0.02 mm too high"}};
  const std::string text = because(d);
  EXPECT_TRUE(text.starts_with("No effect is missing")) << text;
  EXPECT_TRUE(text.ends_with(". Perhaps the zero of run r2 is 0.02 mm too high.")) << text;
}

TEST(Story, AsksForTheKindOfAValveWhoseNumbersAreNotCredible) {
  Diagnosis d;
  d.verdict = Verdict::recalibrate;
  const auto says = [&](const char* name, double deviations) {
    d.recalibrated = {{.fitted = {.name = name, .unit = "m3", .value = 5e-4}, .deviations = deviations}};
    return because(d).find("Not credible: is valve.kind right?") != std::string::npos;
  };
  EXPECT_TRUE(says("muscle.dead_volume", 40.0));
  EXPECT_TRUE(says("mechanics.opposite.valve.conductance", -40.0));
  EXPECT_FALSE(says("muscle.dead_volume", 4.0));
  EXPECT_FALSE(says("muscle.rest_radius", 40.0));
}

TEST(Story, TellsOnlyNumbersThatMovedAndErrorsByADecimal) {
  Diagnosis d;
  d.verdict = Verdict::recalibrate;
  d.recalibrated = {{.fitted = {.name = "effects.bladder_elasticity.ratio", .unit = "1", .value = 0.03},
                     .deviations = 0.01}};
  d.gap.judged = Judged::force;
  d.gap.nominal_rmse = 12.6;
  d.gap.corrected_rmse = 0.512;
  const std::string text = because(d);
  EXPECT_EQ(text.find("ratio"), std::string::npos) << text;
  EXPECT_NE(text.find("falls from 12.6 N to 0.51 N"), std::string::npos) << text;
}

// As the table does: readings in mm became ratios by it.
TEST(Story, TellsErrorsByTheRestLengthThatReadingsGoBy) {
  Diagnosis d;
  d.verdict = Verdict::recalibrate;
  d.gap.nominal_rmse = 0.02;
  d.described.muscle.rest_length_m = 0.25;
  d.corrected.muscle.rest_length_m = 0.2;
  EXPECT_NE(because(d).find("from 5 mm to"), std::string::npos) << because(d);
}

// 0.077 mm are not "within noise" of 0.042 mm without a word on the difference.
TEST(Story, SaysWhatOtherParametersWouldLeaveWhereTheRigAsDescribedLeavesMoreThanNoise) {
  Diagnosis d;
  d.verdict = Verdict::nothing_missing;
  d.gap = {.noise_floor = 1e-4, .nominal_rmse = 1e-4, .recalibrated_rmse = 0.9e-4, .corrected_rmse = 1e-4};
  EXPECT_TRUE(because(d).starts_with("Model and data agree to within noise: on runs held out")) << because(d);
  EXPECT_EQ(because(d).find("recalibrated"), std::string::npos);
  d.gap.nominal_rmse = d.gap.corrected_rmse = 1.8e-4;
  const std::string text = because(d), height = data::amount_of(d.gap.judged, 0.9e-4, d.described);
  EXPECT_NE(text.find("the ± of the parameters"), std::string::npos) << text;
  EXPECT_NE(text.find("(" + height + " with recalibrated parameters; the instruments cannot see below"),
            std::string::npos)
      << text;
  EXPECT_TRUE(text.ends_with("predicts these runs better by more than chance.")) << text;
}

TEST(Story, WritesALawAsASumAndSaysInWhatItCounts) {
  Diagnosis d;
  d.verdict = Verdict::unknown_effect;
  const auto says = [&](const std::string& words) {
    EXPECT_NE(because(d).find("as a force on the load it is " + words), std::string::npos) << because(d);
  };
  d.residual_law = {{"F e^3", {"coefficient", "N", -1599.7, -1616.0, -1584.0}}};
  says("-1600 N x F e^3 (F: the braid's force in 100 N). ");
  d.residual_law.push_back({"sin(2 pi x / 12 mm + 1 rad)", {"coefficient", "N", -0.51234, -0.6, -0.4}});
  d.residual_law.push_back({"P e", {"coefficient", "N", 2.0, 1.9, 2.1}});
  says(
      "-1600 N x F e^3 - 0.512 N x sin(2 pi x / 12 mm + 1 rad) + 2 N x P e (F: the braid's force in 100 N, "
      "P in bar). ");
}

}  // namespace
}  // namespace mckibben::diagnose
