// Joints with two muscles: what a rig would show, what a parameter stands for, who may have what.
#include "joint.hpp"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include <sim/diagnose/candidate.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/priors.hpp>
#include <sim/run/follow.hpp>

#include "planted.hpp"
#include "residuals.hpp"

namespace mckibben::diagnose {
namespace {

TEST(Joint, AnglesAreThoseOfAReplay) {
  const Rig rig = plant::thesis_pair();
  for (const bool commands : {false, true}) {
    const domain::Dataset data = of_a_joint(rig, commands, {.angle_rad = 0.0, .pressure_Pa = 0.0});
    const domain::Run& run = data.runs[1];
    const auto replayed = run::follow(rig, 0.0, run::course_of(run, rig));
    ASSERT_EQ(replayed.samples.size(), run.rows());
    for (std::size_t k = 0; k < run.rows(); k += 10)
      EXPECT_NEAR(replayed.samples[k].angle_rad, run.judged().values[k], 1e-4) << k;
    EXPECT_GT(replayed.samples[40].angle_rad, 0.1);
  }
}

TEST(Joint, ItsOwnDataLeaveTheFloor) {
  const domain::Dataset data = of_a_joint(plant::thesis_pair());
  const Runs all{0, 1, 2, 3, 4};
  const Experiment experiment(data, nothing_masked(data), 2, all);
  EXPECT_NEAR(experiment.floor().jitter, 1e-3, 1e-4);
  EXPECT_GT(experiment.floor().given, 1e-5);
  EXPECT_LT(experiment.floor().judged, 1.2e-3);
  EXPECT_NEAR(experiment.rmse(residuals_of(experiment, data.rig, all), all), experiment.floor().judged, 1e-4);
}

TEST(Joint, APartOfBothSidesIsOneToAFitUnlessTheRigFileHasTwo) {
  const auto named = [](const Rig& rig, const plant::Spreads& stated, const std::string& path) {
    const auto all = nominal_parameters(rig, stated);
    const auto found = std::ranges::find(all, path, &Parameter::path);
    return found == all.end() ? std::optional<Parameter>() : *found;
  };
  Rig rig = plant::thesis_pair();
  EXPECT_TRUE(named(rig, {}, "muscle.rest_radius")->both_sides);
  EXPECT_FALSE(named(rig, {}, "mechanics.opposite.muscle.rest_radius"));
  EXPECT_TRUE(named(rig, {}, "mechanics.link_hangs_at"));
  EXPECT_FALSE(named(rig, {}, "joint.guide_damping"));  // of a load's guide
  auto& two = std::get<plant::Pair>(rig.mechanics).opposite;
  two.muscle.rest_length_m = 0.28;
  EXPECT_FALSE(named(rig, {}, "muscle.rest_radius")->both_sides);
  EXPECT_TRUE(named(rig, {}, "mechanics.opposite.muscle.rest_radius"));
  EXPECT_TRUE(named(rig, {}, "friction.scale")->both_sides);  // another part
  const std::string other = "mechanics.opposite.friction.scale";
  EXPECT_EQ(named(rig, {{other, 0.05}}, other)->scale, 0.05);
  EXPECT_EQ(named(rig, {{"muscle.rest_length", 2e-3}}, "mechanics.opposite.muscle.rest_length")->scale, 2e-3);
}

TEST(Joint, ALinkStaysOneThatCanBe) {
  Rig rig = plant::thesis_pair();
  const plant::Spreads stated{
      {"mechanics.link_mass", 1.0}, {"mechanics.link_length", 0.1}, {"mechanics.link_inertia", 0.1}};
  for (const Parameter& p : nominal_parameters(rig, stated))
    if (stated.contains(p.path)) p.put(rig, p.path.ends_with("inertia") ? p.lowest : p.highest);
  const plant::Link& link = *rig.pair();
  EXPECT_GT(link.length_m, 0.25);
  EXPECT_GE(link.inertia_kg_m2, link.mass_kg * link.length_m * link.length_m * (1.0 - 1e-12));
}

TEST(Joint, AGuideOfALoadIsNoCandidate) {
  const domain::Dataset data = of_a_joint(plant::thesis_pair(), true);
  const auto offered = catalogue(data);
  EXPECT_EQ(std::ranges::find(offered, "guide_friction", &Candidate::effect), offered.end());
  EXPECT_NE(std::ranges::find(offered, "muscle_leak", &Candidate::effect), offered.end());
}

TEST(Joint, WhatIsOfAMuscleIsACandidateOfEach) {
  const domain::Dataset data = of_a_joint(plant::thesis_pair(), true);
  const auto offered = catalogue(data);
  const auto sides = [&](const std::string& effect) {
    return std::ranges::count(offered, effect, &Candidate::effect);
  };
  EXPECT_EQ(sides("muscle_leak"), 3);
  EXPECT_EQ(sides("valve_lag"), 3);
  EXPECT_EQ(sides("supply_droop"), 1);   // there is one supply,
  EXPECT_EQ(sides("encoder_scale"), 1);  // one encoder
  EXPECT_EQ(sides("polytropic_gas"), 1);
  for (const Candidate& candidate : offered) {
    if (candidate.effect != "muscle_leak") continue;
    Rig rig = data.rig;
    EXPECT_TRUE(candidate.fits(rig));
    candidate.put(rig, 1e-10);
    EXPECT_EQ(carries(rig, "muscle_leak", Side::one), candidate.side != Side::two);
    EXPECT_EQ(carries(rig, "muscle_leak", Side::two), candidate.side != Side::one);
    for (const Candidate& next : offered) {
      if (next.effect != "muscle_leak") continue;
      EXPECT_EQ(next.fits(rig), next.side != Side::both && next.side == other(candidate.side));
    }
  }
}

TEST(Joint, ATubeThatPushesIsNoCandidate) {
  const domain::Dataset data = of_a_joint(plant::thesis_pair(), true);
  std::size_t laws = 0;
  for (const Rig& rig : {data.rig, Rig{}})
    for (const Candidate& candidate : rig.pair() != nullptr ? catalogue(data) : catalogue(rig)) {
      if (candidate.effect != plant::BladderElasticity::name) continue;
      EXPECT_FALSE(candidate.either_sign);
      for (const Parameter& p : candidate.parameters(rig)) EXPECT_GT(p.lowest, 0.0) << p.path;
      ++laws;
    }
  EXPECT_EQ(laws, 12u);  // three, of a pair of each muscle and of both
}

TEST(Joint, GaugesOfBothMusclesAreCompared) {
  Rig leaking = plant::thesis_pair();
  std::get<plant::Pair>(leaking.mechanics).opposite.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa =
      3e-10;
  domain::Dataset data = of_a_joint(leaking, true);
  const Loaded pair{leaking};
  for (domain::Run& run : data.runs) {
    for (const std::size_t muscle : {1U, 2U}) run.read("muscle_pressure", {}, muscle);
    const Readings readings = predict(run, {&pair, 1}).front();
    for (const std::size_t muscle : {1U, 2U}) run.readings[muscle].values = readings.readings[muscle];
  }
  const Experiment experiment(data, nothing_masked(data), 2);
  const auto left = residuals_of(experiment, data.rig, {0});
  const auto rows = static_cast<Eigen::Index>(data.runs[0].rows());
  ASSERT_EQ(left.size(), 3 * rows);
  EXPECT_LT(left.segment(rows, rows).norm(), 0.3 * left.tail(rows).norm());  // muscle 2 is the one that leaks
}

TEST(Joint, TensionsOfBothCordsAreReadings) {
  domain::Dataset data = of_a_joint(plant::thesis_pair(), false);
  const Loaded pair{data.rig};
  for (domain::Run& run : data.runs) {
    for (const std::size_t muscle : {1U, 2U}) run.read("force", {}, muscle);
    const Readings readings = predict(run, {&pair, 1}).front();
    for (const std::size_t muscle : {1U, 2U}) run.readings[muscle].values = readings.readings[muscle];
  }
  EXPECT_EQ(data.runs[0].readings[2].channel.key_in_dataset(), "tension_2");
  const auto replayed = run::follow(data.rig, 0.0, run::course_of(data.runs[0], data.rig));
  for (std::size_t k = 0; k < data.runs[0].rows(); k += 10)
    EXPECT_NEAR(replayed.samples[k].opposite.cord_force_N, data.runs[0].readings[2].values[k], 0.5) << k;
  const Experiment experiment(data, nothing_masked(data), 2);
  const auto rows = static_cast<Eigen::Index>(data.runs[0].rows());
  const auto tension_2 = [&](const Rig& rig) { return residuals_of(experiment, rig, {0}).tail(rows).norm(); };
  EXPECT_EQ(residuals_of(experiment, data.rig, {0}).size(), 3 * rows);
  EXPECT_LT(tension_2(data.rig), 1.0);
  Rig weaker = data.rig;
  std::get<plant::Pair>(weaker.mechanics).opposite.muscle.rest_radius_m *= 0.99;
  EXPECT_GT(tension_2(weaker), 100.0);
}

}  // namespace
}  // namespace mckibben::diagnose
