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

}  // namespace
}  // namespace mckibben::input
