// What competed, and what speaks for a name.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <sim/diagnose/competition.hpp>
#include <sim/diagnose/support.hpp>

#include "strained.hpp"

namespace mckibben::diagnose {
namespace {

using Kind = Explanation::Kind;

const Strained& leaky_runs() {
  static const Strained runs = [] {
    plant::Rig truth;
    truth.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 2e-10;
    return Strained(truth);
  }();
  return runs;
}

const Contender& named_leak() {
  static const Contender named = leaky_runs().named("muscle_leak");
  return named;
}

std::vector<Explanation> competed(std::initializer_list<const Contender*> entered,
                                  const Contender* chosen = &named_leak()) {
  Competition competition;
  for (const Contender* one : entered) competition.enter(*leaky_runs().at, *one);
  return competition.told(*leaky_runs().at, chosen);
}

TEST(Competition, TellsWhatWasChosenBeforeTheRigAsDescribedAndItsNumbers) {
  const auto list = competed({&leaky_runs().described, &leaky_runs().recalibrated, &named_leak()});
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0].kind, Kind::effects);
  EXPECT_EQ(list[0].effects, std::vector<std::string>{"muscle_leak"});
  EXPECT_TRUE(list[0].chosen && list[0].as_good);
  EXPECT_EQ(list[1].kind, Kind::numbers);
  EXPECT_EQ(list[2].kind, Kind::nothing);
  EXPECT_FALSE(list[1].as_good || list[2].as_good);
  EXPECT_LT(list[0].misfit, list[1].misfit);
  EXPECT_LT(list[1].misfit, list[2].misfit);
}

TEST(Competition, MeasuresByTheBestWhereNothingIsChosen) {
  const auto list = competed({&leaky_runs().described, &leaky_runs().recalibrated, &named_leak()}, nullptr);
  ASSERT_EQ(list.size(), 3u);
  EXPECT_TRUE(list[0].as_good);
  EXPECT_FALSE(list[1].as_good || list[2].as_good);
  EXPECT_TRUE(std::ranges::none_of(list, &Explanation::chosen));
  EXPECT_TRUE(competed({}, nullptr).empty());
}

TEST(Competition, NothingDoesAsWellThatTheRunsHeldOutSpeakAgainst) {
  Contender rival = named_leak();
  rival.fitted.cost += 0.5 * thresholds.near.clear;
  EXPECT_TRUE(as_good(*leaky_runs().at, named_leak(), rival));
  rival.held_out *= 2.0;
  EXPECT_FALSE(as_good(*leaky_runs().at, named_leak(), rival));
}

TEST(Competition, CountsTheStrainOfNumbersAsEvidence) {
  const auto list = competed({&leaky_runs().described, &leaky_runs().recalibrated});
  double deviations = 0.0;
  const Model& model = leaky_runs().recalibrated.fitted.model;
  for (const Parameter& p : model.free) deviations += std::pow(p.scaled(value_of(model.rig, p.path)), 2);
  EXPECT_NEAR(list[0].strain, deviations, 1e-6 * list[0].misfit);
  EXPECT_NEAR(list[1].strain, 0.0, 1e-9 * list[1].misfit);
}

TEST(Competition, KeepsTheBetterOfTwoThatSayTheSame) {
  Contender worse = named_leak();
  worse.fitted.residuals *= 2.0;
  worse.fitted.cost *= 4.0;
  for (const auto& list : {competed({&worse, &named_leak()}), competed({&named_leak(), &worse})}) {
    ASSERT_EQ(list.size(), 1u);
    EXPECT_NEAR(list[0].misfit, named_leak().fitted.cost, 1e-9);
  }
}

TEST(Competition, DoesNotCountAnEffectThatTheFitDroveToNothing) {
  Contender nothing = named_leak();
  const Candidate& effect = nothing.fitted.model.effects.front();
  effect.put(nothing.fitted.model.rig, effect.absent);
  EXPECT_TRUE(competed({&nothing}).empty());
}

Naming naming_of(Contender best) {
  Naming naming;
  naming.best = std::move(best);
  naming.effects = {{.name = "muscle_leak", .variant = ""}};
  tell_support(*leaky_runs().at, leaky_runs().recalibrated, naming, [](const Doing&) {});
  return naming;
}

TEST(Support, NamesTheRunsThatSpeakForAnEffect) {
  const Support support = naming_of(named_leak()).effects.front().support;
  EXPECT_NEAR(support.fall, leaky_runs().recalibrated.fitted.cost - named_leak().fitted.cost, 1e-9);
  EXPECT_GE(support.by.size(), 3u);
  EXPECT_TRUE(std::ranges::is_sorted(support.by));
  EXPECT_TRUE(support.against.empty());
}

TEST(Support, NamesTheRunsThatSpeakAgainstIt) {
  Contender worse = named_leak();
  worse.held_out = 10.0 * leaky_runs().recalibrated.held_out;
  const Support support = naming_of(worse).effects.front().support;
  EXPECT_EQ(support.against.size(), leaky_runs().at->split.held_out.size());
  for (const std::string& run : support.against) EXPECT_EQ(std::ranges::count(support.by, run), 0);
}

}  // namespace
}  // namespace mckibben::diagnose
