// Units of commands in rig files: what the valve takes, and with it all that the rig measures in it.
#include <gtest/gtest.h>

#include <sim/domain/rig_number.hpp>
#include <sim/input/fields_json.hpp>

#include "rig_text.hpp"

namespace mckibben::input {
namespace {

using plant::CommandUnit;

const std::string pressures = ", zero_pressure: 0.5 bar, span_pressure: 5 bar";

Rig rig_with(const std::string& valve) {
  return rig_of("valve: " + valve);
}

std::string refusal_of(const std::string& text) {
  try {
    rig_of(text);
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

TEST(Commands, HaveTheUnitOfTheValve) {
  const Rig rig = rig_with("{zero_command: 0 mA, span_command: 0.01 A}");
  EXPECT_EQ(rig.command_unit(), CommandUnit::mA);
  EXPECT_EQ(rig.valve.span_command, 10.0);
  EXPECT_EQ(rig_json(rig), rig_json(rig_with("{zero_current: 0 mA, span_current: 10 mA}")));
  EXPECT_EQ(rig_with("{span_command: 10 mA}").valve.zero_command, 4.0);
  const Rig volts = rig_with("{zero_command: -5000 mV, span_command: 5 V" + pressures + "}");
  EXPECT_EQ(volts.command_unit(), CommandUnit::V);
  EXPECT_EQ(volts.valve.zero_command, -5.0);
  EXPECT_EQ(rig_with("{zero_command: 0 kPa, span_command: 800 kPa" + pressures + "}").valve.span_command,
            8.0);
}

TEST(Commands, GiveTheirUnitToAllThatIsMeasuredInIt) {
  const Rig rig = rig_of("valve: {zero_command: -5 V, span_command: 5 V ± 50 mV" + pressures +
                         "}\n"
                         "dac: {largest_command: 10 V}\nfriction: {f1: 0.01 s2/V2}");
  EXPECT_EQ(rig.dac.lowest_command, -5.0);  // else 0 V, and the valve's span
  EXPECT_EQ(rig.dac.largest_command, 10.0);
  EXPECT_EQ(rig.friction.f1_s2_per_mA2, 0.01);
  const Json written = to_json(rig);
  EXPECT_EQ(written.at("valve").at("zero_command"), "-5 V");
  EXPECT_EQ(written.at("valve").at("span_command"), "5 V ± 0.05 V");
  EXPECT_EQ(written.at("friction").at("f1"), "0.01 s2/V2");
  EXPECT_EQ(to_json(rig_of(written.dump())), written);
  Rig copy = rig;
  const domain::RigNumber zero = domain::find_number(copy, "valve.zero_current");  // as it was called
  EXPECT_EQ(zero.unit, "V");
  EXPECT_EQ(zero.lowest, -100.0);
}

TEST(Commands, OfABaseGoWithItsFriction) {
  const Rig rig = rig_of("friction: {f1: 0.01 s2/mA2}");
  Rig volts = rig;
  plant::command_in(volts, CommandUnit::V, 0.0, 8.0);
  const double nu_mA_per_s = 3.0, nu_V_per_s = nu_mA_per_s / 2.0;
  EXPECT_DOUBLE_EQ(volts.friction.f1_s2_per_mA2 * nu_V_per_s * nu_V_per_s,
                   rig.friction.f1_s2_per_mA2 * nu_mA_per_s * nu_mA_per_s);
  EXPECT_EQ(volts.valve.per_mA(), 0.5);
  EXPECT_EQ(rig.valve.per_mA(), 1.0);
}

TEST(Commands, OfOneUnitOnly) {
  EXPECT_NE(refusal_of("valve: {span_command: 10 V}").find("span_command are both in V, both in bar"),
            std::string::npos);
  EXPECT_NE(refusal_of("valve: {zero_command: 0 V, span_command: 5 bar}").find("both in bar"),
            std::string::npos);
  const std::string limits = refusal_of("valve: {zero_command: 0 V, span_command: 10 V" + pressures +
                                        "}\ndac: {largest_current: 20 mA}");
  EXPECT_NE(limits.find("mA is the wrong kind of unit; wanted is V"), std::string::npos) << limits;
}

// 0.5 and 5 bar of the base are at its 4 and 20 mA.
TEST(Commands, InAnotherUnitAskForTheirPressures) {
  const std::string missing =
      refusal_of("valve: {zero_command: 0 V, span_command: 10 V, zero_pressure: 0 bar}");
  EXPECT_NE(missing.find("the key span_pressure is missing"), std::string::npos) << missing;
  EXPECT_NE(missing.find("span_pressure: 6 bar; the base's 5 bar is at 20 mA"), std::string::npos) << missing;
  EXPECT_EQ(missing.find("zero_pressure is missing"), std::string::npos) << missing;
  EXPECT_NE(refusal_of("valve: {zero_command: 0 V, span_command: 10 V}")
                .find("at 4 mA; a flow valve (5/3) has none: kind: on_off, switching: averaged"),
            std::string::npos);
  const std::string unknown = refusal_of("valve: {kind: MPYE, zero_command: 0 V, span_command: 10 V}");
  EXPECT_NE(unknown.find("did you mean on_off?"), std::string::npos) << unknown;
  EXPECT_EQ(unknown.find("pressure is missing"), std::string::npos) << unknown;
  EXPECT_NE(refusal_of("valve: {zero_command: 0 bar, span_command: 8 bar}").find("span_pressure: 8 bar"),
            std::string::npos);
  EXPECT_EQ(refusal_of("base: festo_dmsp_20\nvalve: {zero_command: 0 mA, span_command: 10 mA}"), "");
  EXPECT_EQ(refusal_of("valve: {kind: on_off, zero_command: 0 V, span_command: 24 V}"), "");
}

}  // namespace
}  // namespace mckibben::input
