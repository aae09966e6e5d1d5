// How far a fit goes: rigs that are badly known, whose numbers are far from what is written.
#include <algorithm>
#include <cstdint>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <sim/diagnose/baseline.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/priors.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {
namespace {

/// Each number may be off by three times what is usual, and is off by as much as scatter makes it.
domain::Dataset badly_known(std::uint64_t seed) {
  Rig described;
  for (const Parameter& p : nominal_parameters(described))
    if (p.path != "muscle.dead_volume") described.spreads[p.path] = 3.0 * p.scale;
  Rig truth = described;
  std::mt19937_64 random(seed);
  for (const Parameter& p : nominal_parameters(described, described.spreads))
    p.put(truth,
          std::clamp(p.origin + p.scale * std::normal_distribution(0.0, 1.0)(random), p.lowest, p.highest));
  domain::Dataset data = small(truth, 2.4);
  data.rig.spreads = described.spreads;
  return data;
}

/// Numbers come to bounds on the way.
double left_of_badly_known(std::uint64_t seed) {
  const domain::Dataset data = badly_known(seed);
  const auto masked = nothing_masked(data);
  const Experiment experiment(data, masked, 2);
  Case c{experiment, data.rig, split(data, {0, 1, 2, 3, 4, 5}), 20.0, {}};
  return excess(diagnose::recalibrate(c, replay(c)).contender.fitted.residuals);
}

TEST(Fit, ArrivesHoweverFarTheRigIsFromItsSheet) {
  EXPECT_LT(left_of_badly_known(13), 0.1);
}
TEST(NightlyFit, ArrivesHoweverFarTheRigIsFromItsSheet) {
  EXPECT_LT(left_of_badly_known(21), 0.1);
}

// Numbers make up for each other (by day: Diagnose.HasFineSlopesAlongTheValley), and a play that is used up
// at its own times gives the misfit kinks.
TEST(NightlyFit, ThoroughKnowsHowReadingsChangeAlongTheValley) {
  Rig truth;
  truth.effects.get<plant::SpeedDependentFriction>().ratio = 0.58;
  truth.effects.get<plant::BladderCreep>().stiffness_N_per_m = 300.0;
  truth.effects.get<plant::EncoderBacklash>().width_m = 1e-3;
  const domain::Dataset data = small(truth, 2.4);
  const auto masked = nothing_masked(data);
  const Experiment experiment(data, masked, 2);
  const Runs runs{0, 1, 2, 3, 4, 5};
  Model model{.rig = truth, .free = nominal_parameters(truth)};
  for (const Candidate& candidate : catalogue())
    if (candidate.carried(truth))
      for (const Parameter& p : candidate.parameters(truth)) model.free.push_back(p);
  const Fitted fitted = fit(experiment, model, runs, {.inflation = 1.0, .thorough = true});
  Eigen::MatrixXd normal = fitted.columns.transpose() * fitted.columns;
  normal.diagonal().array() += 1.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(normal);  // the least known first
  const auto read_at = [&](const Eigen::VectorXd& step) {
    const Eigen::VectorXd there = scaled_values(fitted.model) + step;
    return experiment.residuals(rig_at(fitted.model, there.data()), runs);
  };
  for (Eigen::Index i = 0; i < 4; ++i) {
    const Eigen::VectorXd step = 0.15 * axes.eigenvectors().col(i);
    const Eigen::VectorXd met = 0.5 * (read_at(-step) - read_at(step));
    EXPECT_LT((fitted.columns * step - met).norm(), 15.0) << "floors, along axis " << i;
  }
}

}  // namespace
}  // namespace mckibben::diagnose
