// The PID of a lever is that of a load, with an angle in place of a contraction.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <gtest/gtest.h>

#include <controllers/lever_pid.hpp>

namespace mckibben::controllers {
namespace {

/// A wheel of 30 mm and a muscle of 300 mm: a radian counts as a tenth.
Knowledge of_a_lever() {
  Knowledge known;
  known.contraction_per_count = 4e-4;
  known.tick_s = 0.012;
  known.largest_current_mA = 20.0;
  known.model = {0.0075, 0.3, 0.35, 1.11, false};
  known.valve = {4.0, 20.0, 0.5e5, 5e5};
  known.wheel_radius_m = 0.03;
  for (int k = 0; k < 200; ++k) known.target.push_back(0.08 * std::sin(0.03 * k));
  return known;
}

TEST(LeverPid, GivesForAnAngleWhatThePidGivesForItsContraction) {
  LeverPidSettings lever;
  lever.proportional_mA = 12.0;  // mA/rad
  lever.integral_time_s = 0.3;
  lever.derivative_time_s = 0.05;
  lever.dead_zone_rad = 0.02;
  lever.highest_angle_rad = 0.6;
  lever.fastest_joint_rad_per_s = 5.0;
  lever.largest_current_speed_mA_per_s = 100.0;
  PidSettings load;
  load.proportional_mA = 120.0;
  load.integral_time_s = 0.3;
  load.derivative_time_s = 0.05;
  load.dead_zone = 0.002;
  load.highest_target = 0.06;
  load.fastest_load_per_s = 0.5;
  load.largest_current_speed_mA_per_s = 100.0;
  const Knowledge known = of_a_lever();
  const auto of_lever = lever.make(known), of_load = load.make(known);
  EXPECT_EQ(of_lever->rest().current_mA, of_load->rest().current_mA);
  double lowest_mA = 20.0, highest_mA = 0.0;
  for (int k = 0; k < 200; ++k) {
    const auto counts = static_cast<std::int64_t>(std::lround(180.0 * std::sin(0.03 * k - 0.3)));
    const Reading reading{.tick = k, .counts = k == 90 ? counts + 500 : counts};  // once beyond belief
    const double mA = of_load->step(reading).current_mA;
    EXPECT_NEAR(of_lever->step(reading).current_mA, mA, 1e-9) << k;
    lowest_mA = std::min(lowest_mA, mA);
    highest_mA = std::max(highest_mA, mA);
  }
  EXPECT_GT(highest_mA - lowest_mA, 1.0);
  EXPECT_EQ(value_of(of_lever->findings(), "ticks_without_counts"), 1.0);
}

TEST(LeverPid, IsOfAJointWithAnAngle) {
  LeverPidSettings lever;
  lever.proportional_mA = 12.0;
  lever.integral_time_s = lever.derivative_time_s = 0.0;
  Knowledge known = of_a_lever();
  known.wheel_radius_m = 0.0;
  EXPECT_THROW(lever.make(known), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::controllers
