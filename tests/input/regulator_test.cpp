// Regulators in rig files: what their kind and their lag have no use for is neither read nor written.
#include <gtest/gtest.h>

#include <sim/input/diagnostics.hpp>
#include <sim/input/fields_json.hpp>

#include "rig_text.hpp"
#include "says.hpp"

namespace mckibben::input {
namespace {

TEST(RegulatorFile, IsReadWithHowWellItIsKnownAndWrittenBack) {
  const Rig rig = rig_of(
      "valve: {kind: regulator, zero_command: 0 V, span_command: 10 V, zero_pressure: 0 bar, span_pressure: "
      "6 bar, time_constant: 80 ms ± 30 %, "
      "conductance: 18 l/(min bar), venting_conductance: 9 l/(min bar), dead_band: 5 mbar}");
  EXPECT_TRUE(rig.valve.is_regulator());
  EXPECT_DOUBLE_EQ(rig.valve.time_constant_s, 0.08);
  EXPECT_DOUBLE_EQ(rig.spreads.at("valve.time_constant"), 0.024);
  EXPECT_DOUBLE_EQ(rig.valve.venting_conductance_m3_per_s_Pa, 9e-3 / 60.0 / 1e5);
  EXPECT_DOUBLE_EQ(rig.valve.dead_band_Pa, 500.0);
  const Json written = to_json(rig).at("valve");
  EXPECT_EQ(written.at("kind"), "regulator");
  EXPECT_EQ(written.at("lag"), "first_order");
  for (const char* other : {"proportional_band", "natural_frequency", "damping"})
    EXPECT_FALSE(written.contains(other)) << other;
  EXPECT_EQ(to_json(rig_of("valve: " + written.dump())), to_json(rig));
}

TEST(RegulatorFile, OfSecondOrderHasAFrequencyAndADamping) {
  const Rig rig =
      rig_of("valve: {kind: regulator, lag: second_order, natural_frequency: 4 Hz, damping: 0.7}");
  EXPECT_TRUE(rig.valve.swings());
  EXPECT_DOUBLE_EQ(rig.valve.slow_lag_s(), 2.0 * 0.7 / (2.0 * std::numbers::pi * 4.0));
  const Json written = to_json(rig).at("valve");
  EXPECT_FALSE(written.contains("time_constant"));
  EXPECT_EQ(to_json(rig_of("valve: " + written.dump())), to_json(rig));
}

TEST(RegulatorFile, AnUnknownKindIsNoReasonToDoubtItsKeys) {
  try {
    rig_of("valve: {kind: proportional, time_constant: 3 ms}");
    ADD_FAILURE();
  } catch (const BadInput& bad) {
    ASSERT_EQ(bad.problems().size(), 1u) << bad.what();
    EXPECT_TRUE(holds(bad.what(), "kind = proportional is not one of: servo, regulator, on_off, none"));
  }
}

TEST(RegulatorFile, ARuleSaysWhoseTheValuesAreThatAreNotWritten) {
  const auto says = [](const std::string& text) -> std::string {
    try {
      rig_of(text);
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return "";
  };
  EXPECT_TRUE(holds(says("base: thesis\nvalve: {span_pressure: 9 bar}"),
                    "supply_pressure: must not be below span_pressure (supply_pressure = 6 bar, of the base "
                    "thesis)"));
  EXPECT_TRUE(
      holds(says("valve: {supply_pressure: 2 bar}"),
            "supply_pressure = 2 bar: must not be below span_pressure (span_pressure = 5 bar, by default)"));
  EXPECT_TRUE(lacks(says("base: thesis\nvalve: {span_pressure: 9 bar, supply_pressure: 8 bar}"), "base"));
}

TEST(RegulatorFile, AServoValveIsWrittenAsEver) {
  const Json written = to_json(Rig{}).at("valve");
  EXPECT_TRUE(written.contains("proportional_band"));
  for (const char* other : {"kind", "lag", "time_constant", "dead_band"})
    EXPECT_FALSE(written.contains(other)) << other;
}

}  // namespace
}  // namespace mckibben::input
