// The static inverse: its current, put back into the static law, must carry the assumed load.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <controllers/static_inverse.hpp>

#include "planted.hpp"

namespace mckibben::controllers {
namespace {

constexpr double alpha_rad = 20.0 * std::numbers::pi / 180.0;

double force_N(double current_mA, double e, double r0_m) {
  const double pressure_Pa = 0.5e5 + 4.5e5 * (current_mA - 4.0) / 16.0;
  const double tan = std::tan(alpha_rad), sin = std::sin(alpha_rad);
  return std::numbers::pi * r0_m * r0_m * pressure_Pa *
         (3.0 / (tan * tan) * std::pow(1.0 - 1.3 * e, 2) - 1.0 / (sin * sin));
}

StaticInverseSettings of_load(double load_kg) {
  StaticInverseSettings settings;
  settings.assumed_load_kg = load_kg;
  return settings;
}

TEST(StaticInverse, PressureItAsksForCarriesTheAssumedLoad) {
  const std::vector<double> target{0.02, 0.05, 0.1, 0.15, 0.2};
  const auto controller = of_load(16.138).make(data_sheets(target));
  EXPECT_EQ(controller->rest().current_mA, controller->step({0, 0.0, 0}).current_mA);
  for (std::size_t k = 0; k < target.size(); ++k) {
    const double current_mA = controller->step({static_cast<std::int64_t>(k), 0.0, 0}).current_mA;
    EXPECT_GT(current_mA, 4.0);
    EXPECT_LT(current_mA, 20.0);
    EXPECT_NEAR(force_N(current_mA, target[k], 7.5e-3), 16.138 * 9.80665, 1e-9);
  }
}

TEST(StaticInverse, BelievesItsOwnRadiusIfGivenOne) {
  StaticInverseSettings settings = of_load(11.138);
  settings.rest_radius_m = 8.0e-3;
  const double current_mA = settings.make(data_sheets({0.1}))->step({0, 0.0, 0}).current_mA;
  EXPECT_NEAR(force_N(current_mA, 0.1, 8.0e-3), 11.138 * 9.80665, 1e-9);
}

TEST(StaticInverse, StaysOnTheValvesLine) {
  const auto controller = of_load(23.406).make(data_sheets({0.297, 0.9}));
  EXPECT_EQ(controller->step({0, 0.0, 0}).current_mA, 20.0) << "nearly e_max";
  EXPECT_EQ(controller->step({1, 0.012, 0}).current_mA, 20.0) << "beyond e_max";
  EXPECT_EQ(of_load(0.1).make(data_sheets({0.0}))->rest().current_mA, 4.0);
}

TEST(StaticInverse, DoesNotLookAtTheCounts) {
  const auto controller = of_load(16.0).make(data_sheets({0.1}));
  EXPECT_EQ(controller->step({0, 0.0, 0}).current_mA, controller->step({0, 0.0, 400}).current_mA);
}

}  // namespace
}  // namespace mckibben::controllers
