// A lever's angle as the reading that models are held against: what a rig would show, alone and beside
// others.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <sim/data/judged.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/diagnose/priors.hpp>
#include <sim/run/follow.hpp>

#include "planted.hpp"
#include "residuals.hpp"

namespace mckibben::diagnose {
namespace {

Rig forearm() {
  Rig rig;
  plant::Lever lever;
  lever.damping_N_m_s_per_rad = 0.3;
  lever.spring_N_m_per_rad = 1.5;
  rig.mechanics = lever;
  rig.joint.lowest_rad = 0.0;
  return rig;
}

/// Two loads under a sine of the current; readings are what the rig would show.
domain::Dataset lifted(const Rig& truth, double load_kg = 1.0) {
  domain::Dataset data;
  data.rig = forearm();
  data.own_clock = true;
  data.path = "lifted/dataset.yaml";
  for (int i = 0; i < 2; ++i) {
    domain::Run& run = data.runs.emplace_back();
    run.id = i == 0 ? "slow" : "fast";
    run.load_kg = load_kg;
    domain::Measurement& measured = run.measured.emplace();
    for (int k = 0; k < 250; ++k) {
      measured.time_s.push_back(0.012 * k);
      measured.give("command").push_back(11.0 -
                                         5.0 * std::cos((i == 0 ? 2.0 : 5.0) * measured.time_s.back()));
    }
    const Loaded rig{truth, load_kg};
    run.read("angle");
    measured.take("angle") = predict(run, {&rig, 1}, solver::Method::automatic).front().judged();
    run.readings.clear();
  }
  return data::with_rows(std::move(data));
}

TEST(Lever, AnglesAreThoseOfAReplay) {
  const Rig rig = forearm();
  const domain::Dataset data = lifted(rig);
  EXPECT_EQ(data.judged(), domain::Judged::angle);
  for (const domain::Run& run : data.runs) {
    const auto replayed = run::follow(rig, run.load_kg, run::course_of(run, rig));
    ASSERT_EQ(replayed.samples.size(), run.rows());
    double largest = 0.0;
    for (std::size_t k = 0; k < run.rows(); k += 10) {
      EXPECT_NEAR(replayed.samples[k].angle_rad, run.judged().values[k], 1e-4) << k;
      largest = std::max(largest, run.judged().values[k]);
    }
    EXPECT_GT(largest, 0.5);
  }
}

TEST(Lever, RigsBesideEachOtherKeepTheirAngles) {
  std::vector<Loaded> rigs(8, Loaded{forearm(), 1.0});
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    rigs[i].rig.muscle.rest_radius_m *= 1.0 + 0.01 * static_cast<double>(i);
    rigs[i].rig.lever()->base_m += 1e-3 * static_cast<double>(i);
    rigs[i].load_kg += 0.1 * static_cast<double>(i);
  }
  const domain::Dataset data = lifted(forearm());
  const auto together = predict(data.runs.back(), rigs);
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    const auto alone = predict(data.runs.back(), {&rigs[i], 1});
    for (std::size_t k = 0; k < alone.front().judged().size(); k += 20)
      EXPECT_NEAR(together[i].judged()[k], alone.front().judged()[k], 2e-4) << i << ' ' << k;
  }
}

TEST(Lever, AHeavierHandOrALeakIsSeenByItsAngle) {
  const domain::Dataset data = lifted(forearm());
  const Runs all{0, 1};
  const Experiment experiment(data, nothing_masked(data), 1, all);
  EXPECT_LT(experiment.rmse(residuals_of(experiment, data.rig, all), all), 1e-5);
  Rig leaky = forearm();
  leaky.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 3e-10;
  EXPECT_GT(experiment.rmse(residuals_of(experiment, leaky, all), all), 1e-3);
  Rig heavier = forearm();
  heavier.lever()->mass_kg *= 1.2;
  EXPECT_GT(experiment.rmse(residuals_of(experiment, heavier, all), all), 1e-3);
}

TEST(Lever, ItsCandidatesHaveNoLoadGuide) {
  const domain::Dataset data = lifted(forearm());
  for (const Candidate& candidate : catalogue(data)) EXPECT_NE(candidate.effect, "guide_friction");
  for (const Parameter& parameter : nominal_parameters(forearm(), {{"mechanics.mass", 0.1}}))
    EXPECT_TRUE(parameter.path == "joint.load_offset" || !parameter.path.starts_with("joint."))
        << parameter.path;
}

}  // namespace
}  // namespace mckibben::diagnose
