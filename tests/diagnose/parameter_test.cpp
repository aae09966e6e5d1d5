// Parameters by path, and what the catalogue says of each effect.
#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include <sim/diagnose/candidate.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/parameter.hpp>
#include <sim/diagnose/priors.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

TEST(Parameters, AreFoundByTheirPathThroughPartsEffectsAndLists) {
  Rig rig;
  rig.effects.get<plant::ResidualForce>().terms.resize(2);
  *find(rig, "muscle.rest_radius").value = 8e-3;
  *find(rig, "effects.muscle_leak.conductance").value = 1e-10;
  *find(rig, "effects.residual_law.terms.1.coefficient").value = 3.0;
  EXPECT_EQ(rig.muscle.rest_radius_m, 8e-3);
  EXPECT_EQ(rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa, 1e-10);
  EXPECT_EQ(rig.effects.get<plant::ResidualForce>().terms[1].coefficient_N, 3.0);
  EXPECT_EQ(find(rig, "effects.muscle_leak.conductance").unit, "m3/(s.Pa)");
  for (const char* path :
       {"muscle", "muscle.radius", "rest_radius", "effects.residual_law.terms.2.coefficient", ""})
    EXPECT_THROW(find(rig, path), std::invalid_argument) << path;
}

TEST(Catalogue, PointsAtRestShowNoEffectOfSpeedOrTime) {
  domain::Dataset data;
  data.runs.resize(1);
  data.runs.front().measured.emplace();
  const auto has = [&](std::string_view name) {
    return std::ranges::any_of(catalogue(data), [&](const Candidate& c) { return c.effect == name; });
  };
  for (const double point_s : {0.0, 5.0}) {
    data.runs.front().measured->point_s = point_s;
    EXPECT_TRUE(has("guide_friction"));
    for (const char* name : {"reading_delay", "viscous_damping", "speed_dependent_friction", "bladder_creep",
                             "friction_warm_up"})
      EXPECT_EQ(has(name), point_s == 0.0) << name;
  }
}

TEST(Catalogue, HoldsAllEffectsWithANameAndEveryLawMovesSomething) {
  std::set<std::string> effects;
  for (const Candidate& c : catalogue()) {
    effects.insert(c.effect);
    const Rig rig = c.chosen(Rig{});
    EXPECT_EQ(value_of(rig, c.amplitude), c.absent) << c.effect;
    for (const Parameter& p : c.parameters(rig)) {
      EXPECT_LT(p.lowest, p.highest) << p.path;
      EXPECT_NEAR(p.unscaled(p.scaled(1.5 * p.lowest + 0.7)), 1.5 * p.lowest + 0.7, 1e-12) << p.path;
    }
    EXPECT_EQ(c.shapes.empty(), c.shape.empty());
  }
  EXPECT_EQ(effects.size(), plant::Effects::count - 1);  // but for the residual law
}

TEST(NominalParameters, StayWithinThreeDeviationsOfTheirDataSheet) {
  for (const Parameter& p : nominal_parameters(plant::Rig{})) {
    EXPECT_EQ(p.origin, value_of(plant::Rig{}, p.path));
    EXPECT_GE(p.scaled(p.lowest), -thresholds.parameter.most_deviations - 1e-9) << p.path;
    EXPECT_LE(p.scaled(p.highest), thresholds.parameter.most_deviations + 1e-9) << p.path;
    EXPECT_TRUE(p.has_prior);
  }
}

TEST(NominalParameters, AreKnownAsWellAsTheRigSays) {
  const plant::Rig rig;
  const plant::Spreads stated{{"muscle.rest_radius", 4e-4},
                              {"muscle.end_correction", 0.0},
                              {"muscle.rest_length", 1e-3},
                              {"hose.conductance", std::numeric_limits<double>::infinity()},
                              {"tick", 1e-3},
                              {"valve.zero_command", 0.1}};
  const auto usual = nominal_parameters(rig), list = nominal_parameters(rig, stated);
  const auto named = [](const auto& all, std::string_view path) {
    return std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.path == path; });
  };
  EXPECT_DOUBLE_EQ(named(list, "muscle.rest_radius")->scale, 4e-4);
  EXPECT_EQ(named(list, "muscle.end_correction"), list.end());  // exactly known
  ASSERT_NE(named(list, "muscle.rest_length"), list.end());
  EXPECT_DOUBLE_EQ(named(list, "muscle.rest_length")->scale, 1e-3);
  EXPECT_GT(named(list, "hose.conductance")->scale, 2.9 * named(usual, "hose.conductance")->scale);
  EXPECT_EQ(named(list, "friction.scale")->scale, named(usual, "friction.scale")->scale);
  ASSERT_NE(named(list, "valve.zero_command"), list.end());
  EXPECT_DOUBLE_EQ(named(list, "valve.zero_command")->scale, 0.1);
  EXPECT_EQ(list.size(), usual.size() + 1);  // two more, one less
}

TEST(NominalParameters, IncludeTheSizesOfEffectsThatTheRigHas) {
  Rig rig;
  rig.effects.get<plant::ValveDeadBand>().half_width_Pa = 4e3;
  auto& bladder = rig.effects.get<plant::BladderElasticity>();
  bladder.variant = plant::BladderLaw::saturating;
  bladder.stiffness_N_per_m = 50.0;  // of the law that is not chosen
  bladder.force_N = 8.0;
  const auto list = nominal_parameters(rig);
  const auto named = [&](std::string_view path) {
    return std::find_if(list.begin(), list.end(), [&](const Parameter& p) { return p.path == path; });
  };
  const auto band = named("effects.valve_dead_band.half_width");
  ASSERT_NE(band, list.end());
  EXPECT_TRUE(band->has_prior);
  EXPECT_EQ(band->origin, 4e3);
  EXPECT_LT(band->lowest, 1e3);
  EXPECT_GE(band->highest, 16e3);
  ASSERT_NE(named("effects.bladder_elasticity.ratio"), list.end());
  EXPECT_EQ(named("effects.bladder_elasticity.stiffness"), list.end());
  bladder.variant = plant::BladderLaw::saturating_linear;
  EXPECT_EQ(nominal_parameters(rig).size(), list.size() + 1);  // with the stiffness
  EXPECT_TRUE(carries(rig, "valve_dead_band"));
  EXPECT_FALSE(carries(rig, "muscle_leak"));
  EXPECT_EQ(nominal_parameters(plant::Rig{}).size() + 3, list.size());
}

TEST(Catalogue, ALawWithATermMoreIsLookedForWhereTheShorterOneIs) {
  const auto all = catalogue();
  const auto longer = std::ranges::find(all, "saturating_linear", &Candidate::variant);
  const auto shorter = std::ranges::find(all, "saturating", &Candidate::variant);
  ASSERT_NE(longer, all.end());
  Rig rig;
  EXPECT_FALSE(longer->fits(rig));
  EXPECT_TRUE(shorter->fits(rig));
  rig = shorter->chosen(rig);
  shorter->put(rig, 8.0, 0.05);
  EXPECT_TRUE(longer->fits(rig));
  EXPECT_FALSE(shorter->fits(rig));
  rig = longer->chosen(rig);
  longer->put(rig, 100.0);
  EXPECT_TRUE(shorter->carried(rig) && longer->carried(rig));
  EXPECT_FALSE(longer->fits(rig));
  rig = longer->removed(rig);
  EXPECT_TRUE(shorter->carried(rig));
  EXPECT_FALSE(longer->carried(rig));
}

}  // namespace
}  // namespace mckibben::diagnose
