// Valves that are open or shut in rig files: read, written back, and without what such valves have no use
// for.
#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "rig_text.hpp"

namespace mckibben::input {
namespace {

TEST(OnOffFile, IsReadAndWrittenBack) {
  const Rig rig = rig_of(
      "valve: {kind: on_off, ports: 3/2, zero_command: 0 V, span_command: 24 V, supply_pressure: 7 bar, "
      "conductance: 18 l/(min bar), venting_conductance: 9 l/(min bar), venting_critical_ratio: 0.4, "
      "opening_delay: 8 ms ± 2 ms, closing_delay: 5 ms, leak: 0.01 l/(min bar)}");
  EXPECT_TRUE(rig.valve.is_on_off());
  EXPECT_EQ(rig.valve.ports, plant::Ports::three);
  EXPECT_DOUBLE_EQ(rig.valve.opening_delay_s, 0.008);
  EXPECT_DOUBLE_EQ(rig.spreads.at("valve.opening_delay"), 0.002);
  EXPECT_EQ(rig.valve.zero_pressure_Pa, 0.0);
  EXPECT_EQ(rig.valve.span_pressure_Pa, 7e5);
  const Json written = to_json(rig).at("valve");
  EXPECT_EQ(written.at("kind"), "on_off");
  EXPECT_EQ(written.at("ports"), "3/2");
  for (const char* other : {"proportional_band", "zero_pressure", "span_pressure", "lag", "dead_band"})
    EXPECT_FALSE(written.contains(other)) << other;
  EXPECT_EQ(to_json(rig_of("valve: " + written.dump())), to_json(rig));
}

TEST(OnOffFile, PulsesThatEndBeforeTheValveOpensGetAWarning) {
  const auto warned = [](const std::string& valve) {
    std::vector<InputFile> inputs;
    std::vector<Problem> warnings;
    read_rig(Source("rig.yaml",
                    "schema: mckibben-rig/1\nvalve: {kind: on_off, zero_command: 0 V, span_command: 10 V, " +
                        valve + "}\n",
                    ""),
             inputs, &warnings);
    return warnings.empty() ? "" : warnings.front().message;
  };
  EXPECT_EQ(
      warned("switching: pwm, pwm_frequency: 1 kHz, opening_delay: 3 ms"),
      "a period of pwm_frequency lasts 1 ms, and opening_delay 3 ms: no duty below 100 % opens the valve");
  EXPECT_EQ(warned("switching: pwm, pwm_frequency: 50 Hz, opening_delay: 3 ms"), "");
  EXPECT_EQ(warned("opening_delay: 3 ms"), "");
}

}  // namespace
}  // namespace mckibben::input
