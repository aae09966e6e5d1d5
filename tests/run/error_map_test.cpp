// The border of what can be reached against load, and what a map's cells hold.
#include <cmath>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include <sim/input/calibration_file.hpp>
#include <sim/run/error_map.hpp>
#include <sim/run/reachable.hpp>

namespace mckibben::run {
namespace {

using controllers::Branch;

MapPlan small_plan() {
  std::vector<domain::InputFile> files;
  MapPlan plan;
  plan.calibration =
      input::read_calibration(std::filesystem::path(MCKIBBEN_TEST_DATA) / "calibration.yaml", files);
  plan.loads_kg = {16.138, 20.0};
  plan.branches = {Branch::contraction, Branch::relaxation};
  plan.ratios = {0.01, 0.1, 0.18, 0.28};
  plan.speeds_per_s = {0.1, 0.4};
  return plan;
}

ErrorMaps mapped(const MapPlan& plan, unsigned threads = 1) {
  return error_maps(plan, threads, [](const std::string&, std::size_t, std::size_t) {});
}

TEST(ErrorMap, HeavierLoadsReachLessUpwards) {
  const auto reach = reachable(plant::Rig{});
  const std::vector<double> loads_kg{8.87, 11.138, 13.870, 16.138, 18.870, 23.406};
  for (std::size_t i = 1; i < loads_kg.size(); ++i) {
    const auto light = reach.at_load(loads_kg[i - 1]), heavy = reach.at_load(loads_kg[i]);
    EXPECT_LT(heavy.highest, light.highest) << loads_kg[i] << " kg";
    EXPECT_LE(heavy.lowest_rising, light.lowest_rising) << loads_kg[i] << " kg";
    EXPECT_LE(heavy.lowest_falling, light.lowest_falling) << loads_kg[i] << " kg";
    for (double e = 0.05; e < heavy.highest; e += 0.01)
      EXPECT_LT(reach.at_ratio(heavy.rising_per_s, e), reach.at_ratio(light.rising_per_s, e))
          << loads_kg[i] << " kg at " << e;
  }
}

TEST(ErrorMap, ReachEndsAtTheLimitsOfTheWayAndOfTheSpeed) {
  controllers::Reach reach;
  reach.ratio = {0.0, 0.3};
  controllers::ReachOfLoad load;
  load.lowest_rising = 0.01, load.lowest_falling = 0.05, load.highest = 0.2;
  load.rising_per_s = {0.6, 0.0};
  load.falling_per_s = {0.0, 0.3};
  EXPECT_TRUE(within_reach(reach, load, Branch::contraction, 0.1, 0.39));
  EXPECT_FALSE(within_reach(reach, load, Branch::contraction, 0.1, 0.41));
  EXPECT_TRUE(within_reach(reach, load, Branch::relaxation, 0.1, 0.09));
  EXPECT_FALSE(within_reach(reach, load, Branch::relaxation, 0.1, 0.11));
  EXPECT_TRUE(within_reach(reach, load, Branch::contraction, 0.02, 0.01));
  EXPECT_FALSE(within_reach(reach, load, Branch::relaxation, 0.04, 0.01));
  EXPECT_FALSE(within_reach(reach, load, Branch::contraction, 0.21, 0.01));
  EXPECT_FALSE(within_reach(reach, load, Branch::relaxation, 0.21, 0.01));
}

TEST(ErrorMap, EachTargetHasItsRunAndItsMarks) {
  const MapPlan plan = small_plan();
  const ErrorMaps maps = mapped(plan);
  ASSERT_EQ(maps.loads.size(), 2u);
  for (const auto& load : maps.loads) {
    EXPECT_EQ(load.failure, "");
    EXPECT_GT(load.weighed_kg, 5.0);
    EXPECT_GT(load.spread_kg, 0.0);
    ASSERT_EQ(load.branches.size(), 2u);
    for (const auto& map : load.branches) {
      ASSERT_EQ(map.cells.size(), 8u);
      EXPECT_EQ(map.cells[5].ratio, 0.1);
      EXPECT_EQ(map.cells[5].speed_per_s, 0.4);
      for (const auto& cell : map.cells) {
        ASSERT_TRUE(cell.arrival) << cell.failure;
        EXPECT_EQ(cell.asked.ratio_outside, cell.ratio < 0.02 || cell.ratio > 0.20);
        EXPECT_FALSE(cell.reachable && cell.ratio == 0.28);
      }
      EXPECT_TRUE(map.cells[1].reachable) << "e = 0.1 at 0.1 /s";
    }
    // Near e = 0.1 on the way up the load rises, and on the way down it falls.
    EXPECT_GT(load.branches[0].cells[1].arrival->speed_per_s, 0.0);
    EXPECT_GT(load.branches[1].cells[1].arrival->speed_per_s, 0.0);
  }
}

TEST(ErrorMap, DoesNotDependOnThreads) {
  const ErrorMaps one = mapped(small_plan(), 1), three = mapped(small_plan(), 3);
  for (std::size_t load = 0; load < 2; ++load)
    for (std::size_t branch = 0; branch < 2; ++branch)
      for (std::size_t i = 0; i < 8; ++i) {
        const auto &a = one.loads[load].branches[branch].cells[i],
                   &b = three.loads[load].branches[branch].cells[i];
        EXPECT_EQ(a.arrival->ratio, b.arrival->ratio);
        EXPECT_EQ(a.arrival->speed_per_s, b.arrival->speed_per_s);
      }
}

TEST(ErrorMap, MeansAreOverTheChosenCellsThatHaveARun) {
  BranchMap map{Branch::contraction, {}};
  map.cells.push_back({.ratio = 0.1, .speed_per_s = 0.2, .reachable = true, .arrival = Arrival{0.13, 0.2}});
  map.cells.push_back({.ratio = 0.1, .speed_per_s = 0.2, .reachable = true, .arrival = Arrival{0.06, 0.5}});
  map.cells.push_back({.ratio = 0.1, .speed_per_s = 0.2, .reachable = true});
  map.cells.push_back({.ratio = 0.1, .speed_per_s = 0.2, .arrival = Arrival{9.0, 9.0}});
  const MapError error = error_over(map, [](const MapCell& cell) { return cell.reachable; });
  EXPECT_EQ(error.cells, 2u);
  EXPECT_NEAR(error.ratio, std::sqrt((9e-4 + 16e-4) / 2.0), 1e-12);
  EXPECT_NEAR(error.speed_per_s, std::sqrt(0.09 / 2.0), 1e-12);
}

TEST(ErrorMap, ALoadThatCannotBeWeighedHasNoMapAndSaysWhy) {
  MapPlan plan = small_plan();
  plan.loads_kg = {16.138, 120.0};
  plan.extrapolate_load = true;
  const ErrorMaps maps = mapped(plan);
  EXPECT_EQ(maps.loads[0].branches.size(), 2u);
  EXPECT_NE(maps.loads[1].failure.find("weighing"), std::string::npos) << maps.loads[1].failure;
  EXPECT_TRUE(maps.loads[1].branches.empty());
}

}  // namespace
}  // namespace mckibben::run
