// Sensors by data sheet in place of the encoder, and a load cell.
#include <gtest/gtest.h>

#include <plant/instruments.hpp>

namespace mckibben::plant {
namespace {

Rig with_laser() {
  Rig rig;
  rig.sensor = {.kind = SensorKind::laser, .resolution = 1e-5, .lowest = -1e-3, .highest = 0.05};
  return rig;
}

TEST(Sensors, ReadTheNearestStepWithinTheirRange) {
  PositionReader laser(with_laser());
  EXPECT_DOUBLE_EQ(count_height_m(with_laser()), 1e-5);
  EXPECT_EQ(laser.count(1.234e-2), 1234);
  EXPECT_EQ(laser.count(1.2346e-2), 1235);
  EXPECT_EQ(laser.count(-2e-5), -2);
  EXPECT_EQ(laser.count(-0.02), -100);
  EXPECT_EQ(laser.count(0.08), 5000);
  EXPECT_EQ(laser.count(1.234e-2), 1234);
}

TEST(Sensors, APotentiometerSeesAngles) {
  Rig rig;
  rig.sensor.kind = SensorKind::potentiometer;
  rig.sensor.resolution = 1e-3;
  rig.sensor.highest = 1.5;
  EXPECT_DOUBLE_EQ(count_height_m(rig), 1e-3 * rig.joint.wheel_radius_m);
  PositionReader potentiometer(rig);
  EXPECT_EQ(potentiometer.count(0.25 * rig.joint.wheel_radius_m), 250);
  EXPECT_EQ(potentiometer.count(2.0 * rig.joint.wheel_radius_m), 1500);
}

TEST(Sensors, WithoutOneTheEncoderCounts) {
  const Rig rig;
  PositionReader reader(rig);
  PulseCounter counter(rig.encoder.wiring, count_height_m(rig.encoder, rig.joint));
  for (const double x_m : {0.0, 1e-4, 2e-4, 0.0411, 0.02}) EXPECT_EQ(reader.count(x_m), counter.count(x_m));
  EXPECT_EQ(middle_of_count(rig.sensor), 0.5);
  EXPECT_EQ(middle_of_count(with_laser().sensor), 0.0);
}

TEST(Sensors, ALoadCellNeverPushesAndEndsAtItsRange) {
  const LoadCell cell{.fitted = true, .resolution_N = 0.5, .highest_N = 200.0};
  EXPECT_DOUBLE_EQ(cell_reading_N(cell, 100.3, 0.0), 100.5);
  EXPECT_DOUBLE_EQ(cell_reading_N(cell, 100.3, -0.2), 100.0);
  EXPECT_DOUBLE_EQ(cell_reading_N(cell, -30.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(cell_reading_N(cell, 250.0, 1.0), 200.0);
}

}  // namespace
}  // namespace mckibben::plant
