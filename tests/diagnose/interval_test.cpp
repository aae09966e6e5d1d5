// Intervals that neither counting nor an angle without a direction makes wrong.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace mckibben::diagnose
