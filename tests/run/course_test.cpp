// Given columns as what acts on a rig: what is held, what runs straight, and in which steps.
#include <gtest/gtest.h>

#include <sim/run/course.hpp>
#include <sim/run/follow.hpp>

namespace mckibben::run {
namespace {

domain::Measurement two_stamps(domain::Hold hold) {
  domain::Measurement measured;
  measured.time_s = {0.0, 0.03};
  measured.recorded.hold = hold;
  measured.give("command") = {10.0, 13.0};
  measured.give("joint_force") = {0.0, 30.0};
  return measured;
}

TEST(Course, AForceRunsStraightInStepsOfATickAndACommandIsHeld) {
  const Course course = course_of(two_stamps(domain::Hold::usual), plant::Rig{});
  EXPECT_TRUE(course.outer_force);
  ASSERT_EQ(course.drives.size(), 4u);
  EXPECT_DOUBLE_EQ(course.time_s[1], 0.01);
  EXPECT_EQ(course.drives[0].joint_force_N, 5.0);  // its mean on the way to the next
  EXPECT_EQ(course.drives[2].joint_force_N, 25.0);
  EXPECT_EQ(course.drives[2].current_mA, 10.0);
  EXPECT_EQ(course.drives[3].joint_force_N, 30.0);
  EXPECT_EQ(course.rows, (std::vector<std::size_t>{0, 3}));
}

TEST(Course, BothAreHeldOrRunStraightWhereTheDataSaySo) {
  const Course held = course_of(two_stamps(domain::Hold::previous), plant::Rig{});
  ASSERT_EQ(held.drives.size(), 2u);
  EXPECT_EQ(held.drives[0].joint_force_N, 0.0);
  EXPECT_EQ(held.drives[0].current_mA, 10.0);
  const Course linear = course_of(two_stamps(domain::Hold::linear), plant::Rig{});
  ASSERT_EQ(linear.drives.size(), 4u);
  EXPECT_EQ(linear.drives[2].joint_force_N, 25.0);
  EXPECT_EQ(linear.drives[2].current_mA, 12.5);
}

TEST(Course, AValvePressureIsWhatItIsAtAStampAndATorqueAForceOnTheRim) {
  domain::Measurement measured;
  measured.time_s = {0.0, 0.01, 0.02};
  measured.give("valve_pressure", 2) = {1e5, 2e5, 3e5};
  measured.give("joint_torque") = {3.0, 3.0, 3.0};
  const Course course = course_of(measured, plant::Rig{});
  EXPECT_EQ(*course.drives[1].opposite.valve_pressure_Pa, 2e5);
  EXPECT_EQ(*course.toward(1).opposite.valve_pressure_Pa, 3e5);
  EXPECT_EQ(*course.toward(2).opposite.valve_pressure_Pa, 4e5);  // it goes on as it came
  EXPECT_FALSE(course.drives[1].valve_pressure_Pa);
  EXPECT_DOUBLE_EQ(course.drives[1].joint_force_N, -3.0 / plant::Rig{}.joint.wheel_radius_m);
}

// Choked, a valve passes C rho0 P_s: what its volume has taken goes by the mean of a supply that sinks in a
// straight line, R T C rho0/V (P_1 + P_2)/2 t, whatever the rig says of it. Of a pair both draw from it.
TEST(Course, ASupplyThatIsGivenFillsByWhatItHas) {
  plant::Rig rig;
  rig.hose.conductance_m3_per_s_Pa = 1e-12;  // as good as shut
  rig.valve.volume_m3 = 5e-4;
  rig.integrator.tolerance = 1e-9;
  domain::Measurement measured;
  measured.time_s = {0.0, 0.012, 0.072};
  measured.give("command") = {4.0, 20.0, 20.0};
  measured.give("supply_pressure") = {20e5, 20e5, 14e5};
  const Course course = course_of(measured, rig);
  const double rise_Pa = 287.05 * 293.15 * 4e-9 * 1.185 / 5e-4 * (17e5 + 101325.0) * 0.06;
  const auto risen_Pa = [&](const Recording& recording, auto side) {
    return (recording.samples[2].state.*side).valve_pressure_Pa -
           (recording.samples[1].state.*side).valve_pressure_Pa;
  };
  const Recording recording = follow(rig, 10.0, course);
  EXPECT_NEAR(risen_Pa(recording, &plant::State<double>::side), rise_Pa, 5e-5 * rise_Pa);
  EXPECT_TRUE(recording.driven.supply);
  EXPECT_NEAR(recording.samples[1].supply_Pa, 20e5 - 6e5 / 10.0, 1e-3);  // its mean on a fifth of the way
  EXPECT_LT(recording.imbalance.gas, 1e-9);

  measured.give("command", 2) = measured.given("command");
  const plant::Rig pair = plant::pair_of(rig, rig);
  const Recording both = follow(pair, 0.0, course_of(measured, pair));
  EXPECT_NEAR(risen_Pa(both, &plant::State<double>::opposite), rise_Pa, 5e-5 * rise_Pa);
}

}  // namespace
}  // namespace mckibben::run
