// Commands that were recorded as a duty or as a share of the valve's range.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "asked_fixture.hpp"
#include "says.hpp"

namespace mckibben::recognise {
namespace {

KnownRig two_valves() {
  KnownRig rig{.tick_s = 0.012, .rest_length_m = 0.3, .valve = plant::Valve{}};
  rig.valve->kind = plant::ValveKind::on_off;
  rig.valve->switching = plant::Switching::averaged;
  rig.valve->command_unit = plant::CommandUnit::V;
  rig.valve->zero_command = 0.0;
  rig.valve->span_command = 10.0;
  return rig;
}

TEST_F(Asked, ADutyIsOfTheRigsValve) {
  const auto signed_duty = [](int k) {
    return fmt::format("{},{:.1f},{:.3f},{:.3f}", 12 * k, k < 100 ? 80.0 : -40.0, drive(k), 20 * drive(k));
  };
  const std::string head = "t [ms],duty [%],p [bar],x [mm]\n";
  EXPECT_TRUE(holds(column(of(head, signed_duty), "command").unit.reason, "--rig", "on_off"));

  KnownRig rig{.tick_s = 0.012, .rest_length_m = 0.3, .valve = plant::Valve{}};
  plant::Valve& valve = *rig.valve;
  EXPECT_TRUE(column(of(head, signed_duty, "5kg.csv", rig), "command").unit.open()) << "a servo valve";
  valve.kind = plant::ValveKind::on_off;
  valve.command_unit = plant::CommandUnit::V;
  valve.zero_command = 1.0;
  valve.span_command = 9.0;
  const auto brought = [&](const Recognised& found) {
    return shown(found.tables[0], column(found, "command"));
  };
  // 80 % fills, 40 % vents: |2s - 1| of the way s from 1 to 9 V.
  const Recognised two = of(head, signed_duty, "5kg.csv", rig);
  EXPECT_EQ(column(two, "command").unit.value, "V");
  EXPECT_NEAR(brought(two)[0], 1.0 + 0.9 * 8.0, 1e-9);
  EXPECT_NEAR(brought(two)[150], 1.0 + 0.3 * 8.0, 1e-9);
  EXPECT_FALSE(column(two, "contraction").factor) << "it goes with the gauge, not with a flow";
  valve.ports = plant::Ports::three;
  const auto bits = [](int k) { return fmt::format("{},{},{:.3f}", 12 * k, k < 100 ? 255 : 51, drive(k)); };
  const Recognised three = of("t [ms],pwm,p [bar]\n", bits, "5kg.csv", rig);
  EXPECT_NEAR(brought(three)[0], 9.0, 1e-9);
  EXPECT_NEAR(brought(three)[150], 1.0 + 0.2 * 8.0, 1e-9);
  EXPECT_TRUE(holds(column(three, "command").factor->reason, "255"));

  const auto fills = [](int k) { return fmt::format("{},{},{:.3f}", 12 * k, k < 100 ? 0.5 : 0.0, drive(k)); };
  valve.ports = plant::Ports::two;
  const Recognised one_way = of("t [ms],duty,p [bar]\n", fills, "5kg.csv", rig);
  EXPECT_TRUE(holds(column(one_way, "command").factor->reason, "filling less venting"));
  EXPECT_NEAR(brought(one_way)[0], 1.0 + 0.75 * 8.0, 1e-9);
}

TEST_F(Asked, OfTwoDutiesOneColumnIsWritten) {
  const auto two = [](int k) {
    return fmt::format("{},{},{},{:.3f}", 12 * k, k < 100 ? 80 : 0, k < 100 ? 0 : 40, drive(k));
  };
  const auto why = [&](const char* head) { return column(of(head, two), "command").column.reason; };
  EXPECT_TRUE(holds(why("t [ms],duty_fill [%],duty_vent [%],p [bar]\n"),
                    "any of: duty_fill [%]; duty_vent [%];", "write into the tables one column duty of both",
                    "filling less venting, and name it here"));
  EXPECT_EQ(why("t [ms],u_1 [V],u_2 [V],p [bar]\n").find("venting"), std::string::npos);
  const std::string line =
      column(of("t [ms],fill_pwm,vent_pwm,p [bar]\n", two, "5kg.csv", two_valves()), "command").unit.reason;
  EXPECT_TRUE(holds(line, "if 100 is the whole, unit: V, zero: -100, factor: 0.05;",
                    "if 255, unit: V, zero: -255, factor: 0.0196"));
}

TEST_F(Asked, ACommandWithoutAUnitIsAskedForInTheRigs) {
  const auto rows = [](int k) { return fmt::format("{},{},{:.3f}", 12 * k, k < 100 ? -153 : 153, drive(k)); };
  const std::string why =
      column(of("t [ms],cmd,p [bar]\n", rows, "5kg.csv", two_valves()), "command").unit.reason;
  EXPECT_TRUE(holds(why, "says no unit: write V, as the rig's valve takes it", "of a duty, if 100",
                    "if 255, unit: V, zero: -255"));
}

TEST_F(Asked, ADutyThatRestsInItsMiddleIsAsked) {
  const auto rows = [](int k) {
    return fmt::format("{},{:.0f},{:.3f}", 12 * k, 127.5 + 100.0 * std::sin(0.03 * k), drive(k));
  };
  const ColumnGuess guess =
      column(of("t [ms],PWM (0-255),p [bar]\n", rows, "5kg.csv", two_valves()), "command");
  EXPECT_TRUE(guess.unit.open());
  EXPECT_TRUE(holds(guess.unit.reason, "goes both ways: if 127.5 shuts both valves",
                    "unit: V, zero: 0, factor: 0.0392", "if 0 does, unit: V, zero: -255, factor: 0.0196"));
}

TEST_F(Asked, OfEdgesADutyIsNotSaidToFillAbove0) {
  KnownRig rig = two_valves();
  rig.valve->switching = plant::Switching::edges;
  const auto rows = [](int k) { return fmt::format("{},{},{:.3f}", 12 * k, k < 100 ? -40 : 60, drive(k)); };
  EXPECT_TRUE(holds(column(of("t [ms],duty [%],p [bar]\n", rows, "5kg.csv", rig), "command").factor->reason,
                    "fills above a third of that", "switching: pwm or averaged"));
}

TEST_F(Asked, TheValveOfADutyIsOnOrOff) {
  const auto rows = [](int k) { return fmt::format("{},{},{:.3f}", 12 * k, k < 100 ? -153 : 153, drive(k)); };
  const auto rig_of = [&](const std::string& head) {
    std::string text = head, said;
    for (int k = 0; k < 200; ++k) text += rows(k) + "\n";
    for (const Setting& each : recognise({folder_.write("5kg.csv", text)}, false).rig)
      if (each.key.starts_with("valve."))
        said += each.key + ": " + each.told.value + " # " + each.told.reason + "\n";
    return said;
  };
  const std::string duty = rig_of("t [ms],duty,p [bar]\n"), unknown = rig_of("t [ms],cmd,p [bar]\n");
  EXPECT_TRUE(
      holds(duty, "valve.kind: on_off", "valve.switching: FILL_IN", "valve.supply_pressure: FILL_IN"));
  EXPECT_EQ(duty.find("_pressure: FILL_IN # gauge pressure at"), std::string::npos) << duty;
  EXPECT_TRUE(holds(unknown, "valve.kind: FILL_IN", "or on_off"));
  EXPECT_TRUE(holds(unknown, "# command at zero_pressure\n"));
}

TEST_F(Asked, ASensorsVoltageIsNamedAlsoBehindAName) {
  const auto rows = [](int k) { return fmt::format("{},{:.3f},{:.3f}", 12 * k, drive(k), 0.5 + drive(k)); };
  for (const char* name : {"p_V", "p_sensor_V", "p [V]"})
    EXPECT_TRUE(holds(column(of(fmt::format("t [ms],u [V],{}\n", name), rows), "muscle_pressure").unit.reason,
                      "the table says V, which its sensor gives: write unit: bar, factor: the bar of one V"))
        << name;
}

TEST_F(Asked, AStatedPercentIsOneAndAnUnstatedOneIsAsked) {
  const KnownRig rig = two_valves();
  const auto rows = [](double most) {
    return [=](int k) { return fmt::format("{},{},{:.3f}", 12 * k, k < 100 ? -40.0 : most, drive(k)); };
  };
  for (const char* heading : {"duty_%", "duty [%]", "duty (%)"})  // one reading is above the whole
    EXPECT_EQ(column(of(fmt::format("t_ms,{},p_bar\n", heading), rows(102.0), "5kg.csv", rig), "command")
                  .factor->value,
              "0.05")
        << heading;
  for (const double most : {77.0, 300.0}) {  // percent, eight bits, or neither
    const Recognised found = of("t_ms,pwm,p_bar\n", rows(most), "5kg.csv", rig);
    EXPECT_TRUE(column(found, "command").unit.open()) << most;
    EXPECT_TRUE(holds(column(found, "command").unit.reason, "zero: -100", "zero: -255"));
  }
}

}  // namespace
}  // namespace mckibben::recognise
