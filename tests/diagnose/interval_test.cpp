// Intervals that neither counting nor an angle without a direction makes wrong.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/interval.hpp>
#include <sim/run/simulate.hpp>

#include "planted.hpp"

namespace mckibben::diagnose {
namespace {

/// Runs that stand on one count throughout, and a parameter that would move them by ten counts for each unit.
struct Standing {
  domain::Dataset data{};
  Fitted fitted{};

  explicit Standing(std::size_t rows) {
    const double count = run::contraction_per_count(data.rig);
    for (int i = 0; i < 3; ++i) {
      domain::Run run;
      run.current_mA.assign(rows, 8.0);
      run.contraction_ratio.assign(rows, 100.0 * count);
      data.runs.push_back(run);
    }
    fitted.model.rig = data.rig;
    const double value = data.rig.muscle.rest_radius_m;
    fitted.model.free = {{.path = "muscle.rest_radius",
                          .origin = value,
                          .scale = 1e-4,
                          .lowest = 0.5 * value,
                          .highest = 2.0 * value}};
    const auto all = static_cast<Eigen::Index>(3 * rows);
    const double ratio = Experiment(data, nothing_masked(data), 1).floor().judged;
    fitted.residuals = Eigen::VectorXd::Zero(all);
    fitted.columns = Eigen::MatrixXd::Constant(all, 1, 10.0 * count / ratio);
  }

  /// Half of the interval, in counts that it moves the load.
  double half() const {
    const Experiment experiment(data, nothing_masked(data), 1);
    const auto bounds = intervals(experiment, fitted, {0, 1, 2}, 1.0).front();
    return 10.0 * 0.5 * (bounds.high - bounds.low) / 1e-4;
  }
};

TEST(Intervals, OfAReadingThatStandsStillDoNotNarrowWithTime) {
  const double brief = Standing(100).half(), lasting = Standing(3000).half();
  EXPECT_GT(lasting, 0.6 * brief);  // of independent errors less than a fifth would be left
  EXPECT_GT(lasting, 0.45);         // half a count: what nobody can see
  EXPECT_LT(lasting, 1.5);
}

TEST(Intervals, OfAnAngleEndAtHalfATurn) {
  Standing still(100);
  Parameter& p = still.fitted.model.free.front();
  p.period = 2.0 * p.scale;  // as if the radius were an angle
  still.fitted.columns *= 1e-3;
  const Experiment experiment(still.data, nothing_masked(still.data), 1);
  const auto vague = intervals(experiment, still.fitted, {0, 1, 2}, 1.0).front();
  EXPECT_FALSE(vague.determined);
  EXPECT_NEAR(vague.high - vague.low, p.period, 1e-12);
  still.fitted.columns *= 1e3;
  EXPECT_TRUE(intervals(experiment, still.fitted, {0, 1, 2}, 1.0).front().determined);
}

TEST(Intervals, OfAllThatIsAllowedSayThatNothingIsKnown) {
  Standing still(100);
  still.fitted.columns *= 1e-6;
  const Experiment experiment(still.data, nothing_masked(still.data), 1);
  EXPECT_FALSE(intervals(experiment, still.fitted, {0, 1, 2}, 1.0).front().determined);
}

/// Fits of straight lines to noise that is remembered, one as good as another: how many intervals of their
/// numbers, half of which have a prior, hold the true one. Runs so long, in rows.
double covered(Eigen::Index rows) {
  constexpr Eigen::Index numbers = 10;
  constexpr int fits = 200, runs = 6;
  constexpr double remembered = 0.9;  // of each reading's error in the next: a tenth of a second
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  domain::Dataset data;
  for (int i = 0; i < runs; ++i) {
    domain::Run run;
    run.current_mA.assign(static_cast<std::size_t>(rows), 8.0);
    for (Eigen::Index k = 0; k < rows; ++k) run.contraction_ratio.push_back(0.1 + 1e-4 * normal(random));
    data.runs.push_back(std::move(run));
  }
  const Experiment experiment(data, nothing_masked(data), 1);
  const Runs all{0, 1, 2, 3, 4, 5};
  int inside = 0;
  for (int fit = 0; fit < fits; ++fit) {
    Fitted fitted;
    fitted.model.rig = data.rig;
    fitted.columns.resize(runs * rows, numbers);
    fitted.residuals.resize(runs * rows);
    double error = normal(random);
    for (Eigen::Index row = 0; row < runs * rows; ++row) {
      error = remembered * error + std::sqrt(1.0 - remembered * remembered) * normal(random);
      fitted.residuals[row] = error;
    }
    for (Eigen::Index j = 0; j < numbers; ++j) {
      const double phase = 6.0 * normal(random), period = 40.0 * static_cast<double>(1 + j);
      for (Eigen::Index row = 0; row < runs * rows; ++row)
        fitted.columns(row, j) =
            0.1 * std::sin(2.0 * std::numbers::pi * static_cast<double>(row) / period + phase);
    }
    const double inflation = variance_inflation(experiment, fitted.residuals, all);
    Eigen::MatrixXd normal_equations = fitted.columns.transpose() * fitted.columns / inflation;
    Eigen::VectorXd truth = Eigen::VectorXd::Zero(numbers);
    for (Eigen::Index j = 0; j < numbers; ++j) {
      const bool has_prior = j % 2 == 0;
      if (has_prior) {
        normal_equations(j, j) += 1.0;
        truth[j] = normal(random);
      }
      fitted.model.free.push_back({.path = "muscle.rest_radius",
                                   .origin = data.rig.muscle.rest_radius_m,
                                   .scale = 1e-6,
                                   .lowest = 0.0,
                                   .highest = 1.0,
                                   .has_prior = has_prior});
    }
    fitted.residuals += fitted.columns * truth;
    const Eigen::VectorXd found =
        normal_equations.ldlt().solve(fitted.columns.transpose() * fitted.residuals / inflation);
    fitted.residuals -= fitted.columns * found;
    const auto bounds = intervals(experiment, fitted, all, inflation);
    for (Eigen::Index j = 0; j < numbers; ++j)
      inside += std::abs(found[j] - truth[j]) < bounds[static_cast<std::size_t>(j)].half ? 1 : 0;
  }
  return static_cast<double>(inside) / (fits * numbers);
}

TEST(Intervals, HoldTheTruthAsOftenAsTheySay) {
  EXPECT_NEAR(covered(750), 0.95, 0.03);
}

TEST(Intervals, AreNotTooNarrowWhereSegmentsAreHardlyMoreThanNumbers) {
  EXPECT_GT(covered(250), 0.92);
}

}  // namespace
}  // namespace mckibben::diagnose
