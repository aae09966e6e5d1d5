// Sizes of an effect in parts of the data: one that is there is the same everywhere, one that stands in for
// another is not.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/constancy.hpp>
#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/priors.hpp>

#include "examined.hpp"

namespace mckibben::diagnose {
namespace {

/// One effect of the catalogue fitted to all runs of a data set, and how constant it is.
Constancy constancy_of(const domain::Dataset& data, const std::string& effect) {
  const Experiment experiment(data, no_doubts(data).masked, 2);
  const Runs runs{0, 1, 2, 3, 4, 5};
  Model model{data.rig, nominal_parameters(data.rig)};
  for (const Candidate& candidate : catalogue(data)) {
    if (candidate.effect != effect) continue;
    model.rig = candidate.chosen(model.rig);
    if (candidate.shapes.empty())
      candidate.put(model.rig, candidate.typical);
    else
      candidate.put(model.rig, candidate.typical, candidate.shapes.front());
    for (const Parameter& p : candidate.parameters(model.rig)) model.free.push_back(p);
    model.effects.push_back(candidate);
    break;
  }
  const Fitted fitted = fit(experiment, model, runs, {.inflation = 1.0, .thorough = true});
  EXPECT_EQ(fitted.failure, "");
  return constancies(experiment, fitted.model, runs, variance_inflation(experiment, fitted.residuals, runs))
      .front();
}

plant::Rig leaking() {
  plant::Rig rig;
  rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 4e-10;
  return rig;
}

TEST(Constancy, AnEffectThatIsThereIsTheSameEverywhere) {
  const Constancy constancy = constancy_of(small(leaking()), "muscle_leak");
  ASSERT_EQ(constancy.size(), 3u);  // load, motion, speed
  EXPECT_EQ(constancy[0].along, "load");
  ASSERT_EQ(constancy[0].sizes.size(), 3u);
  EXPECT_EQ(constancy[0].sizes[1].part, "16.138 kg");
  for (const Drift& along : constancy)
    for (const SizeIn& size : along.sizes)
      if (size.error < 4e-11) {
        EXPECT_NEAR(size.value, 4e-10, 4e-11) << size.part;
      }
  EXPECT_TRUE(constancy.is_shown());
  EXPECT_EQ(constancy.drift(), nullptr);
}

/// Counts that are taken for longer ones look like a bladder that pulls back, until it is seen in motion.
TEST(Constancy, AnEffectThatStandsInIsNot) {
  plant::Rig elastic;
  elastic.effects.get<plant::BladderElasticity>().stiffness_N_per_m = 1800.0;
  const Constancy constancy = constancy_of(small(elastic), "encoder_scale");
  ASSERT_NE(constancy.drift(), nullptr);
  EXPECT_EQ(constancy.drift()->along, "speed");
  EXPECT_GT(constancy.drift()->deviations, thresholds.constancy.deviations);
}

const Eigen::Matrix2d independent{{1.0, 0.0}, {0.0, 1.0}};

TEST(Drift, CountsOnlyWhatIsCertain) {
  EXPECT_EQ(drift_of("load", {{"a", 10.0, 1.0}, {"b", 13.0, 1.0}}, independent, 10.0).deviations, 0.0);
  const Drift far = drift_of("load", {{"a", 10.0, 1.0}, {"b", 16.0, 1.0}}, independent, 12.0);
  EXPECT_NEAR(far.deviations, 6.0 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(far.share, 0.5, 1e-12);
  EXPECT_TRUE(far.drifts());
}

TEST(Drift, CountsErrorsThatPartsHaveInCommonOnce) {
  const Eigen::Matrix2d together{{1.0, 0.99}, {0.99, 1.0}};
  EXPECT_TRUE(drift_of("load", {{"a", 10.0, 1.0}, {"b", 14.0, 1.0}}, together, 10.0).drifts());
}

TEST(Drift, IsNoneWhereItIsASmallShare) {
  const Drift drift = drift_of("load", {{"a", 100.0, 1.0}, {"b", 110.0, 1.0}}, independent, 100.0);
  EXPECT_GT(drift.deviations, 4.0);
  EXPECT_FALSE(drift.drifts());
}

TEST(Drift, PartsThatKnowNothingSayNothing) {
  const double none = std::numeric_limits<double>::infinity();
  const Eigen::Matrix2d blind{{none, 0.0}, {0.0, 1.0}};
  const Drift drift = drift_of("speed", {{"below", 500.0, none}, {"above", 10.0, 1.0}}, blind, 10.0);
  EXPECT_EQ(drift.deviations, 0.0);
  EXPECT_EQ(drift.known, 1u);
  EXPECT_FALSE(Constancy{drift}.is_shown());
}

}  // namespace
}  // namespace mckibben::diagnose
