// Controllers of two muscles on data sheets made by hand: what P0 and a difference are in currents, limits,
// and that a PID follows a joint as simple as a spring.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <controllers/settings.hpp>

namespace mckibben::controllers {
namespace {

constexpr double degree_rad = std::numbers::pi / 180.0;

/// Two of the thesis's muscles; the opposite valve has other ends.
Knowledge known(std::vector<double> angles_rad, std::vector<double> stiffness = {}) {
  Knowledge k;
  k.contraction_per_count = 0.25 * degree_rad * 0.1;  // R/l0 = 0.1
  k.tick_s = 0.012;
  k.largest_current_mA = 20.0;
  k.model = {0.0075, 0.3, 20.0 * degree_rad, 1.11, false};
  k.valve = {4.0, 20.0, 0.5e5, 5e5};
  k.target = std::move(angles_rad);
  for (double& each : k.target) each *= 0.1;
  k.wheel_radius_m = 0.03;
  k.pair = {.opposite = {0.008, 0.28, 22.0 * degree_rad, 1.05, false},
            .opposite_valve = {4.0, 20.0, 0.0, 6e5},
            .mounted_ratio = 0.1,
            .opposite_mounted_ratio = 0.12,
            .stiffness_N_m_per_rad = std::move(stiffness)};
  return k;
}

JointTerms held_at(double co_contraction_Pa) {
  JointTerms terms;
  terms.co_contraction_Pa = co_contraction_Pa;
  return terms;
}

/// Torque of nominal muscles over the angle, by differences.
double stiffness(const Knowledge& k, double ratio, double pressure_1_Pa, double pressure_2_Pa) {
  const auto torque = [&](double angle_rad) {
    const double R = k.wheel_radius_m;
    return R * (k.model.force_N(0.1 + R * angle_rad / 0.3, pressure_1_Pa) -
                k.pair->opposite.force_N(0.12 - R * angle_rad / 0.28, pressure_2_Pa));
  };
  const double at_rad = ratio / ratio_per_rad(k);
  return (torque(at_rad - 1e-5) - torque(at_rad + 1e-5)) / 2e-5;
}

TEST(CoContraction, IsTheMeanOfBothPressures) {
  const Knowledge k = known({0.0});
  CoContraction both(held_at(2e5), k);
  const Command command = both.command(1.5);
  const double one_Pa = k.valve.pressure_Pa(command.current_mA),
               two_Pa = k.pair->opposite_valve.pressure_Pa(command.opposite_mA);
  EXPECT_NEAR(0.5 * (one_Pa + two_Pa), 2e5, 1e-6);
  EXPECT_NEAR(command.current_mA - both.command(0.0).current_mA, 1.5, 1e-12);
}

TEST(CoContraction, StiffensNominalMusclesAsWanted) {
  const Knowledge k = known({20.0 * degree_rad}, {14.0});
  CoContraction both({}, k);
  for (const double difference_mA : {-2.0, 0.0, 1.5}) {
    both.begin_tick(0, difference_mA);
    const Command command = both.command(difference_mA);
    EXPECT_NEAR(stiffness(k, k.target_at(0), k.valve.pressure_Pa(command.current_mA),
                          k.pair->opposite_valve.pressure_Pa(command.opposite_mA)),
                14.0, 1e-5);
  }
  both.begin_tick(0, 0.0);
  const double before_Pa = both.pressure_Pa();
  both.begin_tick(0, 0.0, 1e4);
  EXPECT_NEAR(both.pressure_Pa() - before_Pa, 1e4, 1e-6);
}

TEST(CoContraction, KeepsBothPressuresOnTheirLinesWhateverIsAsked) {
  const Knowledge k = known({0.0});
  for (const double co_Pa : {0.0, 1e5, 4.9e5, 9e5}) {
    CoContraction both(held_at(co_Pa), k);
    EXPECT_LE(both.differences().lowest_mA, both.differences().highest_mA) << co_Pa;
    for (const double end_mA : {both.differences().lowest_mA, both.differences().highest_mA}) {
      const Command command = both.command(end_mA);
      EXPECT_NEAR(
          k.valve.pressure_Pa(command.current_mA) + k.pair->opposite_valve.pressure_Pa(command.opposite_mA),
          2.0 * both.pressure_Pa(), 1e-6);
    }
  }
  EXPECT_THROW(CoContraction({}, Knowledge{}), std::invalid_argument);
}

TEST(CoContraction, BothCurrentsKeepTheirSpeedThroughAStepOfStiffness) {
  std::vector<double> wanted(100, 9.0);
  std::fill(wanted.begin() + 50, wanted.end(), 18.0);
  const Knowledge k = known(std::vector<double>(100, 0.0), wanted);
  PairPidSettings settings;
  settings.proportional_mA = 50.0;
  settings.integral_time_s = 0.1;
  settings.derivative_time_s = 0.0;
  settings.largest_current_speed_mA_per_s = 20.0;
  const auto controller = settings.make(k);
  const Command rest = controller->rest();
  Command before = rest;
  for (std::int64_t tick = 0; tick < 100; ++tick) {
    const Command now = controller->step({tick, 0.0, tick % 7 < 3 ? 40 : -40});  // full of unrest
    EXPECT_LE(std::abs(now.current_mA - before.current_mA), 0.24 + 1e-9) << tick;
    EXPECT_LE(std::abs(now.opposite_mA - before.opposite_mA), 0.24 + 1e-9) << tick;
    before = now;
  }
  EXPECT_GT(before.current_mA + before.opposite_mA, rest.current_mA + rest.opposite_mA + 5.0);
}

/// A joint whose angle follows the difference of the currents with a lag.
class Joint {
 public:
  void step(const Command& command) {
    angle_rad_ += 0.2 * (0.1 * (command.current_mA - rest_.current_mA) - angle_rad_);
  }
  explicit Joint(const Command& rest) : rest_(rest) {}
  std::int64_t counts() const { return std::llround(std::floor(angle_rad_ / (0.25 * degree_rad))); }
  double angle_rad() const { return angle_rad_; }

 private:
  Command rest_;
  double angle_rad_ = 0.0;
};

PairPidSettings quiet_pid() {
  PairPidSettings settings;
  settings.proportional_mA = 5.0;
  settings.integral_time_s = 0.06;
  settings.derivative_time_s = 0.0;
  settings.co_contraction_Pa = 2.5e5;
  return settings;
}

TEST(PairPid, BringsTheJointToItsAngleAndCutsWhatIsNotAllowed) {
  for (const bool cut : {false, true}) {
    PairPidSettings settings = quiet_pid();
    if (cut) settings.highest_angle_rad = 10.0 * degree_rad;
    const auto controller = settings.make(known(std::vector<double>(300, 20.0 * degree_rad)));
    Joint joint(controller->rest());
    for (std::int64_t tick = 0; tick < 300; ++tick) joint.step(controller->step({tick, 0.0, joint.counts()}));
    EXPECT_NEAR(joint.angle_rad(), (cut ? 10.0 : 20.0) * degree_rad, 0.3 * degree_rad);
  }
}

// A target out of reach for a while: with a wound-up integral the joint would stay at the end for as long.
TEST(PairPid, DoesNotWindUp) {
  std::vector<double> target(400, 80.0 * degree_rad);
  std::fill(target.begin() + 200, target.end(), 0.0);
  const auto controller = quiet_pid().make(known(target));
  Joint joint(controller->rest());
  for (std::int64_t tick = 0; tick < 240; ++tick) joint.step(controller->step({tick, 0.0, joint.counts()}));
  EXPECT_LT(std::abs(joint.angle_rad()), 8.0 * degree_rad);
}

TEST(PairPid, HoldsItsOutputWhileCountsJump) {
  PairPidSettings settings = quiet_pid();
  settings.fastest_joint_rad_per_s = 20.0;  // 55 counts in a tick
  const auto controller = settings.make(known(std::vector<double>(100, 0.0)));
  const Command steady = controller->step({0, 0.0, 0});
  const Command jumped = controller->step({1, 0.012, 5000});
  EXPECT_EQ(jumped.current_mA, steady.current_mA);
  EXPECT_EQ(jumped.opposite_mA, steady.opposite_mA);
  ASSERT_EQ(controller->findings().size(), 1u);
  EXPECT_EQ(controller->findings().front().value, 1.0);
}

TEST(PairPid, ActsOnCountsAsOldAsItsDelay) {
  PairPidSettings settings = quiet_pid();
  settings.feedback_delay_ticks = 3;
  settings.integral_time_s = 0.0;
  const auto controller = settings.make(known(std::vector<double>(100, 0.0)));
  const double rest_mA = controller->step({0, 0.0, 0}).current_mA;
  for (std::int64_t tick = 1; tick <= 3; ++tick)
    EXPECT_EQ(controller->step({tick, 0.0, 40}).current_mA, rest_mA) << tick;
  EXPECT_LT(controller->step({4, 0.0, 40}).current_mA, rest_mA - 0.5);
}

TEST(PairPid, NeedsItsGains) {
  EXPECT_TRUE(PairPidSettings{}.needs_tuning());
  EXPECT_THROW(PairPidSettings{}.make(known({0.0})), std::invalid_argument);
  EXPECT_THROW(PairModelInverseSettings{}.make(known({0.0})), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::controllers
