// Where a recalibration begins if numbers are hardly known.
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/starts.hpp>

#include "strained.hpp"

namespace mckibben::diagnose {
namespace {

/// Runs of a rig whose valve passes so many times what is written.
struct Written {
  domain::Dataset data;
  std::vector<std::vector<bool>> masked;

  explicit Written(double times, double deviation) {
    plant::Rig truth;
    truth.valve.conductance_m3_per_s_Pa *= times;
    data = small(truth, 2.4);
    data.rig.spreads["valve.conductance"] = deviation;
    masked = nothing_masked(data);
  }
};

constexpr double unknown = std::numeric_limits<double>::infinity();

TEST(Starts, AreOneWhereNumbersAreKnown) {
  const Written written(1.0, 1e-10);
  const Experiment experiment(written.data, written.masked, 2);
  Case c{experiment, written.data.rig, split(written.data, {0, 1, 2, 3, 4, 5}), 20.0, {}};
  const Contender described = replay(c);
  EXPECT_TRUE(places_to_begin(c, described.fitted.model).empty());
}

TEST(Starts, AreSeveralWhereANumberIsUnknownAndTheBestIsNearTheTruth) {
  const Written written(1.8, unknown);
  const Experiment experiment(written.data, written.masked, 2);
  Case c{experiment, written.data.rig, split(written.data, {0, 1, 2, 3, 4, 5}), 20.0, {}};
  const Contender described = replay(c);
  const auto places = places_to_begin(c, described.fitted.model);
  ASSERT_EQ(places.size(), thresholds.starts.begun);
  const double told = written.data.rig.valve.conductance_m3_per_s_Pa;
  EXPECT_NEAR(places.front().rig.valve.conductance_m3_per_s_Pa, 1.8 * told, 0.15 * told);
  for (const Model& place : places) EXPECT_EQ(place.rig.friction.scale, written.data.rig.friction.scale);

  const Recalibrated found = diagnose::recalibrate(c, described);
  EXPECT_EQ(found.begun, 3u);
  EXPECT_TRUE(found.other_ends.empty());  // one valley
  EXPECT_NEAR(found.contender.fitted.model.rig.valve.conductance_m3_per_s_Pa, 1.8 * told, 0.05 * told);
}

TEST(Starts, AreWhereOneNumberIsFarOffIfThatExplainsMost) {
  plant::Rig truth;
  truth.friction.scale = 1.46;
  const auto data = small(truth, 2.4);
  const auto masked = nothing_masked(data);
  const Experiment experiment(data, masked, 2);
  Case c{experiment, data.rig, split(data, {0, 1, 2, 3, 4, 5}), 20.0, {}};
  Model described = replay(c).fitted.model;
  for (Parameter& p : described.free) p.highest = std::max(p.highest, 1.4 * p.origin);
  const auto places = one_number_far_off(c, described);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_NEAR(places.front().rig.friction.scale, 1.4, 1e-9);  // four deviations of a tenth
  EXPECT_EQ(places.front().rig.muscle.rest_radius_m, data.rig.muscle.rest_radius_m);
}

// Of two fits the one that is better so far ended at a bound, far from what the data say.
TEST(Starts, DeepenTheBestTrialOnlyAndOnlyWhereMuchIsLeft) {
  plant::Rig truth;
  truth.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 2e-10;
  const Strained runs(truth);
  const Case& c = *runs.at;
  const Screening screening = screen_at(c, runs.described);
  const auto score = std::ranges::find(screening.scores, "muscle_leak",
                                       [](const Score& one) { return one.candidate.effect; });
  ASSERT_NE(score, screening.scores.end());
  Trial stuck = rough(c, runs.described, *score, 0);
  stuck.contender.fitted.model.rig.friction.scale = 0.7;
  stuck.contender.fitted.residuals =
      c.experiment.residuals(stuck.contender.fitted.model.rig, c.split.training);
  stuck.contender.held_out = c.experiment.residuals(stuck.contender.fitted.model.rig, c.split.held_out);
  Trial worse = stuck;
  stuck.contender.fitted.cost = 1e6;
  worse.contender.fitted.cost = 2e6;
  std::vector<Trial> trials{worse, stuck};
  const Rig described = runs.data.rig;
  deepen_best(c, trials, {&described}, [](const Doing&) {});
  EXPECT_TRUE(near_floor(trials[1].contender.fitted.residuals));
  EXPECT_NEAR(trials[1].contender.fitted.model.rig.friction.scale, 1.0, 0.1);
  EXPECT_EQ(trials[0].contender.fitted.cost, 2e6);

  stuck.contender.held_out.setZero();
  std::vector<Trial> met{stuck};
  deepen_best(c, met, {&described}, [](const Doing&) {});
  EXPECT_EQ(met[0].contender.fitted.cost, 1e6);
}

TEST(Starts, AreTheShapesOfTheCatalogueAtOwnNumbersAndAtOthers) {
  Model model;
  model.free = {{.path = "muscle.rest_radius", .has_prior = true}};
  for (const Candidate& candidate : catalogue())
    if (candidate.effect == "muscle_leak" || candidate.effect == "speed_dependent_friction")
      model.effects.push_back(candidate);
  ASSERT_EQ(model.effects.size(), 2u);  // one has no shape
  const Candidate& friction =
      *std::ranges::find(model.effects, "speed_dependent_friction", &Candidate::effect);
  friction.put(model.rig, 0.6, 0.5);
  Rig other;
  other.muscle.rest_radius_m = 0.009;
  std::vector<std::pair<double, double>> expected, found;
  for (const double radius_m : {0.009, model.rig.muscle.rest_radius_m})
    for (const double shape : friction.shapes) expected.emplace_back(radius_m, shape);
  for (const Model& place : in_other_shapes(model, {&other})) {
    found.emplace_back(place.rig.muscle.rest_radius_m, value_of(place.rig, friction.shape));
    EXPECT_EQ(value_of(place.rig, friction.amplitude), 0.6);
  }
  EXPECT_GT(friction.shapes.size(), 1u);
  EXPECT_EQ(found, expected);
}

TEST(Starts, TakeOverNumbersButNotEffects) {
  Model model;
  model.free = {{.path = "muscle.rest_radius", .has_prior = true},
                {.path = "effects.muscle_leak.conductance", .has_prior = true}};
  Rig other;
  other.muscle.rest_radius_m = 0.009;
  other.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 1e-10;
  const Model begun = begun_at(model, other);
  EXPECT_EQ(begun.rig.muscle.rest_radius_m, 0.009);
  EXPECT_EQ(begun.rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa, 0.0);
}

TEST(Starts, DisagreeWhereOneEndsClearlyHigher) {
  EXPECT_FALSE(disagree({}));
  EXPECT_FALSE(disagree({100.0, 121.9, 105.0}));  // within a tenth and a clear difference
  EXPECT_TRUE(disagree({100.0, 122.1}));
}

}  // namespace
}  // namespace mckibben::diagnose
