// Tables of what is reachable: interpolation, and a target slowed by them.
#include <cmath>

#include <gtest/gtest.h>

#include <controllers/reach.hpp>

#include "planted.hpp"

namespace mckibben::controllers {
namespace {

TEST(Reach, IsLinearBetweenLoadsAndRatiosAndKeepsItsEnds) {
  Reach reach = even_reach();
  reach.loads[0].highest = 0.3;
  reach.loads[1].highest = 0.1;
  reach.loads[0].rising_per_s = {1.0, 2.0, 3.0};
  reach.loads[1].rising_per_s = {3.0, 4.0, 5.0};
  const ReachOfLoad middle = reach.at_load(50.5);
  EXPECT_NEAR(middle.highest, 0.2, 1e-12);
  EXPECT_NEAR(reach.at_ratio(middle.rising_per_s, 0.05), 2.5, 1e-12);
  EXPECT_NEAR(reach.at_ratio(middle.rising_per_s, 0.2), 3.5, 1e-12);
  EXPECT_NEAR(reach.at_ratio(middle.rising_per_s, -1.0), 2.0, 1e-12);
  EXPECT_NEAR(reach.at_ratio(middle.rising_per_s, 1.0), 4.0, 1e-12);
  EXPECT_NEAR(reach.at_load(0.1).highest, 0.3, 1e-12);
  EXPECT_NEAR(reach.at_load(500.0).highest, 0.1, 1e-12);
}

TEST(Slowed, NeverExceedsTheReachableSpeed) {
  Reach reach = even_reach();
  for (auto& load : reach.loads) {
    load.rising_per_s = {0.8, 0.3, 0.0};
    load.falling_per_s = {0.0, 0.2, 0.6};
  }
  const ReachOfLoad load = reach.at_load(16.0);
  std::vector<double> target;
  for (int k = 0; k < 600; ++k) target.push_back(k < 50 ? 0.05 : k < 300 ? 0.19 : k < 400 ? 0.0 : 0.12);
  const auto followed = slowed(target, 0.012, reach, load);
  ASSERT_EQ(followed.size(), target.size());
  for (std::size_t k = 1; k < followed.size(); ++k) {
    const double speed = (followed[k] - followed[k - 1]) / 0.012;
    EXPECT_LE(speed, reach.at_ratio(load.rising_per_s, followed[k - 1]) + 1e-9);
    EXPECT_GE(speed, -reach.at_ratio(load.falling_per_s, followed[k - 1]) - 1e-9);
    EXPECT_LE(followed[k], load.highest);
  }
}

TEST(Slowed, LeavesATargetAloneThatIsReachable) {
  const Reach reach = even_reach();
  std::vector<double> target;
  for (int k = 0; k < 400; ++k) target.push_back(0.1 + 0.05 * std::sin(0.02 * k));
  EXPECT_EQ(slowed(target, 0.012, reach, reach.at_load(16.0)), target);
}

TEST(Slowed, ArrivesLaterAtTheSameHeightAndStopsAtTheEnds) {
  const Reach reach = even_reach();
  const ReachOfLoad load = reach.at_load(16.0);
  const auto step = slowed(std::vector<double>(100, 0.1), 0.012, reach, load);
  EXPECT_EQ(step.front(), 0.1) << "where it begins it may begin";
  std::vector<double> target(400, 0.05);
  for (std::size_t k = 10; k < 200; ++k) target[k] = 0.29;
  for (std::size_t k = 200; k < 400; ++k) target[k] = 0.0;
  const auto followed = slowed(target, 0.012, reach, load);
  EXPECT_NEAR(followed[10], 0.05 + 0.5 * 0.012, 1e-12);
  EXPECT_EQ(followed[199], 0.2) << "the highest it can reach";
  EXPECT_EQ(followed[399], 0.03) << "the lowest, coming from above";
}

TEST(Slowed, MayBeginLowerThanItCanFall) {
  const Reach reach = even_reach();
  const auto followed = slowed(std::vector<double>(10, 0.015), 0.012, reach, reach.at_load(16.0));
  for (const double e : followed) EXPECT_EQ(e, 0.015);
}

}  // namespace
}  // namespace mckibben::controllers
