// Ranges of commands in rig files: in mA they are the valve's currents, in V or bar they stand beside them.
#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "rig_text.hpp"

namespace mckibben::input {
namespace {

Rig rig_with(const std::string& valve) {
  return rig_of("valve: " + valve);
}

TEST(Commands, InMilliampereAreCurrents) {
  const Rig rig = rig_with("{zero_command: 0 mA, span_command: 0.01 A}");
  EXPECT_EQ(rig.valve.zero_current_mA, 0.0);
  EXPECT_EQ(rig.valve.span_current_mA, 10.0);
  EXPECT_EQ(rig_json(rig), rig_json(rig_with("{zero_current: 0 mA, span_current: 10 mA}")));
  EXPECT_EQ(rig_with("{span_command: 10 mA}").valve.zero_current_mA, 4.0);
}

TEST(Commands, InVoltsOrBarStandBesideTheCurrentsAndReadBack) {
  const Rig volts = rig_with("{zero_command: -5000 mV, span_command: 5 V}");
  EXPECT_EQ(volts.valve.zero_current_mA, 4.0);
  EXPECT_EQ(volts.valve.current_for_mA(-5.0), 4.0);
  EXPECT_EQ(volts.valve.current_for_mA(0.0), 12.0);
  const Json written = to_json(volts).at("valve");
  EXPECT_EQ(written.at("zero_command"), "-5 V");
  EXPECT_EQ(to_json(rig_with(written.dump())).at("valve"), written);
  EXPECT_EQ(to_json(rig_with("{zero_command: 0 kPa, span_command: 800 kPa}")).at("valve").at("span_command"),
            "8 bar");
  EXPECT_FALSE(to_json(Rig{}).at("valve").contains("zero_command"));
}

}  // namespace
}  // namespace mckibben::input
