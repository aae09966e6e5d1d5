// Sensors by data sheet in place of the encoder, and a load cell.
#include <numbers>

#include <gtest/gtest.h>

#include <plant/instruments.hpp>

namespace mckibben::plant {
namespace {

Rig with_laser() {
  Rig rig;
  rig.sensors.position() = {.kind = SensorKind::laser, .resolution = 1e-5, .lowest = -1e-3, .highest = 0.05};
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
  rig.sensors.position() = {.kind = SensorKind::potentiometer, .resolution = 1e-3, .highest = 1.5};
  EXPECT_DOUBLE_EQ(count_height_m(rig), 1e-3 * rig.joint.wheel_radius_m);
  PositionReader potentiometer(rig);
  EXPECT_EQ(potentiometer.count(0.25 * rig.joint.wheel_radius_m), 250);
  EXPECT_EQ(potentiometer.count(2.0 * rig.joint.wheel_radius_m), 1500);
}

TEST(Sensors, WithoutOneTheEncoderCounts) {
  const Rig rig;
  PositionReader reader(rig);
  PulseCounter counter(EncoderWiring::ideal, 2.0 * std::numbers::pi * 0.030 / (720 * 2));
  for (const double x_m : {0.0, 1e-4, 2e-4, 0.0411, 0.02}) EXPECT_EQ(reader.count(x_m), counter.count(x_m));
  EXPECT_EQ(middle_of_count(rig.sensors.position()), 0.5);
  EXPECT_EQ(middle_of_count(with_laser().sensors.position()), 0.0);
}

TEST(Sensors, AreCutOffAtTheirRangeAndRounded) {
  const Sensor cell{
      .signal = Sensed::force, .kind = SensorKind::load_cell, .resolution = 0.5, .highest = 200.0};
  EXPECT_DOUBLE_EQ(shown(&cell, 100.3), 100.5);
  EXPECT_DOUBLE_EQ(shown(&cell, 100.1), 100.0);
  EXPECT_DOUBLE_EQ(shown(&cell, 251.0), 200.0);
}

TEST(Sensors, OfOneSignalThereIsOneAndThePositionsIsTheFirst) {
  Sensors sensors;
  sensors.put(gauge(100.0));
  sensors.put(gauge(1e3));
  ASSERT_EQ(sensors.size(), 2u);
  EXPECT_EQ(sensors.of(Sensed::muscle_pressure)->resolution, 1e3);
  EXPECT_EQ(shown(sensors.of(Sensed::muscle_pressure), 1.234e5), 1.23e5);
  sensors.put({.kind = SensorKind::laser, .resolution = 1e-5});
  EXPECT_EQ(sensors.position().kind, SensorKind::laser);
  sensors.remove(Sensed::muscle_pressure);
  EXPECT_EQ(sensors.of(Sensed::muscle_pressure), nullptr);
  EXPECT_EQ(shown(nullptr, 1.234e5), 1.234e5);
}

}  // namespace
}  // namespace mckibben::plant
