// Sensors in rig files: a potentiometer's numbers are angles, and a rig without a sensor is written as ever.
#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "rig_text.hpp"

namespace mckibben::input {
namespace {

TEST(SensorFile, ALaserIsReadWithHowWellItIsKnownAndWrittenBack) {
  const RigFile rig = rig_of(
      "sensor: {kind: laser, resolution: 10 um, noise: 30 um, accuracy: 0.06 mm, highest: 80 mm ± 1 mm}\n"
      "load_cell: {fitted: true, noise: 0.2 N, highest: 1 kN}");
  EXPECT_EQ(rig.sensor.kind, plant::SensorKind::laser);
  EXPECT_DOUBLE_EQ(rig.sensor.resolution, 1e-5);
  EXPECT_DOUBLE_EQ(rig.sensor.highest.value(), 0.08);
  EXPECT_FALSE(rig.sensor.lowest);
  EXPECT_DOUBLE_EQ(rig.spreads.at("sensor.highest"), 1e-3);
  EXPECT_DOUBLE_EQ(rig.load_cell.highest_N.value(), 1000.0);
  const Json written = to_json(rig);
  EXPECT_EQ(to_json(rig_of("sensor: " + written.at("sensor").dump() +
                           "\nload_cell: " + written.at("load_cell").dump())),
            written);
}

TEST(SensorFile, APotentiometersNumbersAreAngles) {
  const RigFile rig = rig_of("sensor: {kind: potentiometer, resolution: 0.1 deg, lowest: -10 deg}");
  EXPECT_DOUBLE_EQ(rig.sensor.resolution, 0.1 * plant::degree_rad);
  EXPECT_EQ(to_json(rig_of("sensor: " + to_json(rig).at("sensor").dump())), to_json(rig));
}

TEST(SensorFile, WithoutOneNothingIsWritten) {
  const Json written = to_json(RigFile{});
  EXPECT_FALSE(written.contains("sensor"));
  EXPECT_FALSE(written.contains("load_cell"));
}

}  // namespace
}  // namespace mckibben::input
