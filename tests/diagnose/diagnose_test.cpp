// What the workflow's parts may not depend on. Whole diagnoses: tests/workflow.
#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/fit.hpp>
#include <sim/diagnose/priors.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {
namespace {

TEST(Diagnose, HasTheSameSlopesForAnyNumberOfThreads) {
  const auto data = small(plant::Rig{});
  const auto masked = nothing_masked(data);
  const auto parameters = nominal_parameters(data.rig);
  const Runs runs{0, 3, 4};
  const auto one = Experiment(data, masked, 1).slopes(data.rig, parameters, runs);
  const auto three = Experiment(data, masked, 3).slopes(data.rig, parameters, runs);
  EXPECT_EQ(one.residuals, three.residuals);
  EXPECT_EQ(one.columns, three.columns);
  EXPECT_GT(one.columns.norm(), 1.0);
}

TEST(Diagnose, HasFineSlopesAlongTheValleyWhereNumbersMakeUpForEachOther) {
  auto data = small(plant::Rig{}, 2.4);
  for (const Parameter& p : nominal_parameters(data.rig)) data.rig.spreads[p.path] = 3.0 * p.scale;
  const auto masked = nothing_masked(data);
  const Experiment experiment(data, masked, 2);
  const auto parameters = nominal_parameters(data.rig, data.rig.spreads);
  const Runs runs{0, 1, 2, 3, 4, 5};
  const Eigen::MatrixXd fine = experiment.fine_slopes(data.rig, parameters, runs).columns;
  const Eigen::MatrixXd normal = fine.transpose() * fine;
  const Eigen::VectorXd along = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(normal).eigenvectors().col(0);
  const auto gone = [&](double way) {
    Rig rig = data.rig;
    for (std::size_t j = 0; j < parameters.size(); ++j)
      parameters[j].put(rig, parameters[j].unscaled(way * along[static_cast<Eigen::Index>(j)]));
    return experiment.residuals(rig, runs);
  };
  const Eigen::VectorXd true_slope = (gone(-0.1) - gone(0.1)) / 0.2;
  const auto off = [&](const Eigen::MatrixXd& columns) { return (columns * along - true_slope).norm(); };
  EXPECT_LT(off(fine), 0.3 * off(experiment.slopes(data.rig, parameters, runs).columns));
  EXPECT_NEAR((fine * along).norm(), true_slope.norm(), 0.3 * true_slope.norm());
}

TEST(Diagnose, HasFineSlopesAtTheEdgeOfARange) {
  const auto data = small(plant::Rig{}, 2.4);
  const auto masked = nothing_masked(data);
  const Experiment experiment(data, masked, 2);
  auto parameters = nominal_parameters(data.rig);
  const auto inside = experiment.fine_slopes(data.rig, parameters, {0}).columns;
  for (Parameter& p : parameters) p.lowest = p.origin;  // there is one side only
  const auto at_the_edge = experiment.fine_slopes(data.rig, parameters, {0}).columns;
  for (Eigen::Index j = 0; j < inside.cols(); ++j)
    EXPECT_LT((at_the_edge - inside).col(j).norm(), 0.2 * inside.col(j).norm())
        << parameters[static_cast<std::size_t>(j)].path;
}

TEST(Diagnose, TakesForNoiseWhatRepeatedRunsDoNotRepeat) {
  auto data = small(plant::Rig{});
  const auto masked = [&] { return nothing_masked(data); };
  const NoiseFloor single = Experiment(data, masked(), 1).floor();
  EXPECT_EQ(single.repeats, 0.0);
  EXPECT_NEAR(single.judged, std::hypot(single.count / std::sqrt(12.0), 5e-5), 1e-5);

  data.runs.push_back(data.runs.front());
  for (double& ratio : data.runs.back().contraction_ratio) ratio += 6.0 * single.count;
  const std::size_t last = data.runs.size() - 1;
  EXPECT_NEAR(Experiment(data, masked(), 1, {0, 1, last}).floor().judged, 6.0 * single.count / std::sqrt(2.0),
              1e-9);
  EXPECT_EQ(Experiment(data, masked(), 1, {0, 1}).floor().repeats, 0.0);
  data.runs.back().load_kg += 1.0;
  EXPECT_EQ(Experiment(data, masked(), 1, {0, 1, last}).floor().repeats, 0.0);
}

TEST(Diagnose, KnowsCountsAlsoWhenTheyAreRoundedToAFewDecimals) {
  auto data = small(plant::Rig{});
  const auto floor = [&] { return Experiment(data, nothing_masked(data), 1).floor(); };
  const NoiseFloor exact = floor();
  for (domain::Run& run : data.runs)
    for (double& ratio : run.contraction_ratio) ratio = std::round(ratio * 1e4) / 1e4;
  EXPECT_EQ(floor().count, exact.count);
  EXPECT_GT(floor().judged, exact.judged);
  EXPECT_LT(floor().judged, 1.1 * exact.judged);
  for (domain::Run& run : data.runs)
    for (double& ratio : run.contraction_ratio) ratio += 1e-4;  // no counts any more
  EXPECT_EQ(floor().count, 0.0);
}

TEST(Diagnose, TakesForNoiseWhatScattersFromTickToTick) {
  auto data = small(plant::Rig{});
  std::mt19937_64 dice(1);
  std::normal_distribution<double> noise(0.0, 2e-3);
  std::vector<std::vector<bool>> masked;
  for (auto& run : data.runs) {
    masked.emplace_back(run.current_mA.size(), false);
    for (double& ratio : run.contraction_ratio) ratio += noise(dice);
  }
  EXPECT_NEAR(Experiment(data, masked, 1).floor().judged, 2e-3, 2e-4);
}

TEST(Fit, RefusesParametersThatNoReadingDependsOn) {
  const auto data = small(plant::Rig{});
  const auto masked = nothing_masked(data);
  Model model{.rig = data.rig, .free = nominal_parameters(data.rig)};
  // The warm-up's time says nothing as long as nothing warms up.
  model.free.push_back({.path = "effects.friction_warm_up.time",
                        .scale = 1.0,
                        .step = 0.01,
                        .lowest = 1.0,
                        .highest = 100.0,
                        .logarithmic = true});
  const Fitted fitted = fit(Experiment(data, masked, 2), model, {0, 2, 5}, {.inflation = 1.0});
  EXPECT_EQ(fitted.failure, "");
  EXPECT_EQ(fitted.model.refused, std::vector<std::string>{"effects.friction_warm_up.time"});
  EXPECT_EQ(fitted.model.free.size() + 1, model.free.size());
  EXPECT_EQ(fitted.columns.cols(), static_cast<Eigen::Index>(fitted.model.free.size()));
}

}  // namespace
}  // namespace mckibben::diagnose
