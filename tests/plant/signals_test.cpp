// The list of signals: names and units that files have, which of them a rig has, and that no two are alike.
#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <plant/signals.hpp>

namespace mckibben::plant {
namespace {

std::string names_of(const std::vector<Channel>& channels) {
  std::string names;
  for (const Channel& channel : channels) names += (names.empty() ? "" : ",") + channel.name();
  return names;
}

TEST(Signals, TheFileOfARunBeginsWithTheColumnsThatOthersReadItBy) {
  EXPECT_EQ(
      names_of(recorded_channels({}, {}))
          .find("time_s,current_mA,contraction_ratio,contraction_speed_per_s,valve_pressure_bar,"
                "muscle_pressure_bar,encoder_contraction_ratio,bristle_m,braid_force_N,friction_force_N"),
      0u);
  EXPECT_EQ(names_of(recorded_channels({}, {.pair = true}))
                .find("time_s,current_1_mA,current_2_mA,angle_rad,angle_speed_rad_per_s,valve_pressure_1_bar,"
                      "muscle_pressure_1_bar,valve_pressure_2_bar,muscle_pressure_2_bar,tension_1_N,"
                      "tension_2_N,encoder_angle_rad,contraction_ratio_1,contraction_ratio_2"),
            0u);
}

TEST(Signals, CommandsAreInWhatTheValveTakes) {
  Rig rig;
  command_in(rig, CommandUnit::V, 0.0, 10.0);
  EXPECT_EQ(names_of(measured_channels(rig, {})), "time_s,command_V,encoder_contraction_ratio");
  EXPECT_EQ(names_of(recorded_channels(rig, {.pair = true})).find("time_s,command_1_V,command_2_V,"), 0u);
  command_in(rig, CommandUnit::bar, 0.0, 5.0);
  Sample row;
  row.current_mA = 2.5;
  const auto channels = channels_of(rig, {});
  const Channel& command = channel_of(channels, "command");
  EXPECT_EQ(command.name(), "command_bar");
  EXPECT_EQ(command.value(row), 2.5);
  EXPECT_EQ(in_unit(CommandUnit::V, "currents of 4 mA, 2 s2/mA2"), "commands of 4 V, 2 s2/V2");
}

TEST(Signals, AValveThatIsOpenOrShutIsAskedForNoPressure) {
  Rig rig;
  const auto asks = [&] {
    return std::ranges::any_of(channels_of(rig, {}),
                               [](const Channel& one) { return one.key() == "reference_pressure"; });
  };
  EXPECT_TRUE(asks());
  rig.valve.kind = ValveKind::on_off;
  EXPECT_FALSE(asks());
}

TEST(Signals, WhatIsGivenHasNothingUpstreamAndALengthHasAForce) {
  const std::string given =
      names_of(recorded_channels({}, {.length = true, .pressure = {GivenPressure::muscle}}));
  EXPECT_EQ(given.find("time_s,contraction_ratio,contraction_speed_per_s,muscle_pressure_bar,force_N,"
                       "encoder_contraction_ratio"),
            0u);
  const std::string one = names_of(
      recorded_channels({}, {.pair = true, .pressure = {GivenPressure::none, GivenPressure::muscle}}));
  EXPECT_NE(one.find("current_1_mA"), std::string::npos);
  EXPECT_EQ(one.find("current_2_mA"), std::string::npos);
  EXPECT_EQ(one.find("valve_pressure_2_bar"), std::string::npos);
}

TEST(Signals, OfEveryRigHaveNamesOfTheirOwn) {
  Rig fitted;
  fitted.sensors.put(gauge());
  fitted.sensors.put({.signal = Sensed::force, .kind = SensorKind::load_cell});
  for (const Driven& driven : {Driven{}, Driven{.pair = true}, Driven{.length = true}}) {
    std::set<std::string> keys, names;
    for (const Channel& channel : channels_of(fitted, driven)) {
      EXPECT_TRUE(keys.insert(channel.key()).second) << channel.key();
      EXPECT_TRUE(names.insert(channel.name()).second) << channel.name();
      EXPECT_EQ(channel.name().find(channel.key()), 0u);
      EXPECT_TRUE(channel.words().find("the muscle") == std::string::npos || channel.muscle == 0)
          << channel.words();
    }
    EXPECT_TRUE(keys.contains(driven.pair ? "gauge_pressure_2" : "gauge_pressure"));
  }
}

TEST(Signals, AReadingIsInADataSetWhatItReads) {
  Rig fitted;
  fitted.sensors.put(gauge());
  fitted.sensors.put({.signal = Sensed::force, .kind = SensorKind::load_cell});
  std::string measured;
  for (const Channel& channel : recorded_channels(fitted, {}))
    if (channel.signal->kind == Kind::reading) measured += channel.name_in_dataset() + " ";
  EXPECT_EQ(measured, "contraction_ratio muscle_pressure_bar force_N ");
  for (const Signal& signal : signals)
    if (!signal.reads.empty()) {
      EXPECT_EQ(signal_of(signal.reads).unit.name, signal.unit.name) << signal.key;
    }
  EXPECT_THROW(signal_of("torque_of_nothing"), std::invalid_argument);
}

TEST(Signals, AFurtherSensorIsAFurtherColumn) {
  Rig fitted;
  fitted.sensors.put({.signal = Sensed::valve_pressure, .kind = SensorKind::gauge});
  const std::string one = names_of(recorded_channels(fitted, {}));
  EXPECT_TRUE(one.ends_with(",gauge_valve_pressure_bar")) << one;
  EXPECT_EQ(names_of(recorded_channels({}, {})), one.substr(0, one.rfind(',')));
  EXPECT_TRUE(names_of(recorded_channels(fitted, {.pair = true, .pressure = {GivenPressure::muscle}}))
                  .ends_with(",gauge_valve_pressure_2_bar"));
  EXPECT_EQ(recorded_channels(fitted, {}).back().name_in_dataset(), "valve_pressure_bar");
  for (const auto& [sensed, key] : names(Sensed{}))
    if (sensed != Sensed::contraction) {
      EXPECT_TRUE(std::ranges::any_of(signals, [&, name = key](const Signal& s) { return s.reads == name; }))
          << key << " has a column";
    }
}

TEST(Signals, ValuesAreInTheUnitOfTheColumnAndOfThePage) {
  Sample row;
  row.state.opposite.muscle_pressure_Pa = 2.5e5;
  row.angle_rad = 90.0 * degree_rad;
  const auto channels = channels_of({}, {.pair = true});
  EXPECT_EQ(channel_of(channels, "muscle_pressure_2").value(row), 2.5);
  EXPECT_EQ(channel_of(channels, "muscle_pressure_1").value(row), 0.0);
  EXPECT_EQ(channel_of(channels, "angle").value(row), row.angle_rad);
  EXPECT_EQ(channel_of(channels, "angle").on_page(row), 90.0);
  EXPECT_EQ(channel_of(channels, "angle").page_unit(), "deg");
  EXPECT_THROW(channel_of(channels, "contraction_ratio"), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::plant
