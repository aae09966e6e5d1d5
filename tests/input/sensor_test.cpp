// Sensors in rig files: the list on top of the base's, the keys from before there was one, and what is
// refused.
#include <gtest/gtest.h>

#include <sim/domain/rig_number.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/yaml_reader.hpp>

#include "rig_text.hpp"

namespace mckibben::input {
namespace {

using plant::Sensed, plant::SensorKind;

constexpr const char* laser_and_cell =
    "sensors:\n"
    "  - {signal: contraction, kind: laser, resolution: 10 um, noise: 30 um, accuracy: 0.06 mm,\n"
    "     highest: 80 mm ± 1 mm}\n"
    "  - {signal: force, kind: load_cell, noise: 0.2 N, highest: 1 kN}\n";

TEST(SensorFile, ALaserIsReadWithHowWellItIsKnownAndWrittenBack) {
  const Rig rig = rig_of(laser_and_cell);
  const plant::Sensor& laser = rig.sensors.position();
  EXPECT_EQ(laser.kind, SensorKind::laser);
  EXPECT_DOUBLE_EQ(laser.resolution, 1e-5);
  EXPECT_DOUBLE_EQ(laser.highest.value(), 0.08);
  EXPECT_FALSE(laser.lowest);
  EXPECT_DOUBLE_EQ(rig.spreads.at("sensors.contraction.highest"), 1e-3);
  EXPECT_DOUBLE_EQ(rig.sensors.of(Sensed::force)->highest.value(), 1000.0);
  const Json written = to_json(rig);
  EXPECT_EQ(to_json(rig_of("sensors: " + written.at("sensors").dump())), written);
}

TEST(SensorFile, APotentiometersNumbersAreAngles) {
  const Rig rig =
      rig_of("sensors: [{signal: contraction, kind: potentiometer, resolution: 0.1 deg, lowest: -10 deg}]");
  EXPECT_DOUBLE_EQ(rig.sensors.position().resolution, 0.1 * plant::degree_rad);
  EXPECT_EQ(to_json(rig_of("sensors: " + to_json(rig).at("sensors").dump())), to_json(rig));
}

TEST(SensorFile, KeysFromBeforeTheListMeanTheSame) {
  EXPECT_EQ(to_json(rig_of("sensor: {kind: laser, resolution: 10 um, noise: 30 um, accuracy: 0.06 mm, "
                           "highest: 80 mm ± 1 mm}\n"
                           "load_cell: {fitted: true, noise: 0.2 N, highest: 1 kN}")),
            to_json(rig_of(laser_and_cell)));
  EXPECT_EQ(to_json(rig_of("encoder: {wheel_ratio: 3, wiring: crosswise}\n"
                           "gauge: {fitted: true, resolution: 1 mbar}")),
            to_json(rig_of("sensors:\n"
                           "  - {signal: contraction, kind: encoder, wheel_ratio: 3, wiring: crosswise}\n"
                           "  - {signal: muscle_pressure, kind: gauge, resolution: 1 mbar}")));
  EXPECT_EQ(to_json(rig_of("encoder: {wheel_ratio: 3}\n"
                           "gauge: {fitted: false, resolution: 1 mbar}\n"
                           "sensor: {kind: laser, resolution: 1 mm}")),
            to_json(rig_of("sensors: [{signal: contraction, kind: laser, resolution: 1 mm}]")));
}

TEST(SensorFile, WhatTheBaseHasStaysUntilItIsNamed) {
  const auto changed = [](const std::string& list) {
    const YamlFile file = parse_yaml(Source("rig.yaml", "sensors: " + list, ""));
    plant::Sensors sensors;
    sensors.put(plant::gauge(100.0));
    Problems problems;
    read_sensors(file.source, *file.root.find("sensors"), sensors, problems, {});
    problems.raise();
    return sensors;
  };
  const plant::Sensors finer = changed("[{signal: muscle_pressure, kind: gauge, noise: 2 mbar}]");
  ASSERT_EQ(finer.size(), 2u);
  EXPECT_EQ(finer[1].resolution, 100.0);
  EXPECT_DOUBLE_EQ(finer[1].noise, 200.0);
  EXPECT_EQ(finer.position().kind, SensorKind::encoder);
  const plant::Sensors without = changed(
      "[{signal: muscle_pressure, kind: none}, {signal: contraction, kind: laser, resolution: 1 mm}]");
  ASSERT_EQ(without.size(), 1u);
  EXPECT_EQ(without.position().kind, SensorKind::laser);
}

TEST(SensorFile, AnEncoderOfItsOwnIsToldTheGearingThatItTakesOver) {
  const auto said_of = [](const std::string& encoder) {
    std::vector<InputFile> inputs;
    std::vector<Problem> warnings;
    read_rig(Source("rig.yaml", "schema: mckibben-rig/1\nbase: festo_dmsp_20\n" + encoder, ""), inputs,
             &warnings);
    return warnings.empty() ? "" : warnings.front().message;
  };
  const std::string says =
      "pulses_per_turn = 2500 without wheel_ratio: the base's 2 turns of the disk for one of the joint stay; "
      "write wheel_ratio: 1 if there is no gearing";
  EXPECT_EQ(said_of("sensors: [{signal: contraction, kind: encoder, pulses_per_turn: 2500}]"), says);
  EXPECT_EQ(said_of("encoder: {pulses_per_turn: 2500}"), says);
  EXPECT_EQ(said_of("encoder: {pulses_per_turn: 2500, wheel_ratio: 2}"), "");
  EXPECT_EQ(said_of("encoder: {wiring: ideal}"), "");
}

TEST(SensorFile, TheNumbersOfSensorsAreFoundByTheirSignalAndAsTheyWereCalled) {
  Rig rig = rig_of(laser_and_cell);
  rig.sensors.put(plant::gauge(100.0));
  const auto value = [&](const char* path) { return domain::find_number(rig, path).value; };
  EXPECT_DOUBLE_EQ(*value("sensors.contraction.noise"), 3e-5);
  EXPECT_EQ(value("sensor.noise"), value("sensors.contraction.noise"));
  EXPECT_EQ(value("gauge.resolution"), &rig.sensors.of(Sensed::muscle_pressure)->resolution);
  EXPECT_EQ(*value("load_cell.noise"), 0.2);
  EXPECT_EQ(value("encoder.wheel_ratio"), nullptr);  // it has none
  EXPECT_EQ(value("sensors.flow.noise"), nullptr);
}

}  // namespace
}  // namespace mckibben::input
