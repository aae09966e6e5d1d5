// Valve and hose by themselves, between pressures that are given: what passes, and which way.
#include <gtest/gtest.h>

#include <plant/valve_flow.hpp>

namespace mckibben::plant {
namespace {

constexpr HoseEnds<double> ends{4e5, 3e5};

ValveMoment<double> at(const Rig& rig, double error_Pa, const Effects* effects = nullptr) {
  return ValveFlow(rig).proportional(ends, error_Pa, SideMemory<double>{}, HeldSide{}, effects);
}

TEST(ValveFlow, AServoValveOpensByItsBandOneWayAtATimeAndNoFurtherThanItCan) {
  const Rig rig;
  const double band_Pa = rig.valve.proportional_band_Pa;
  const auto half = at(rig, 0.5 * band_Pa), full = at(rig, band_Pa), beyond = at(rig, 3.0 * band_Pa);
  EXPECT_DOUBLE_EQ(half.valve_opening, 0.5);
  EXPECT_DOUBLE_EQ(half.supply_flow, 0.5 * full.supply_flow);
  EXPECT_EQ(half.vent_flow, 0.0);
  EXPECT_EQ(beyond.supply_flow, full.supply_flow);
  const auto venting = at(rig, -0.5 * band_Pa);
  EXPECT_EQ(venting.supply_flow, 0.0);
  // Choked: it vents to less than b_c of its own pressure.
  EXPECT_DOUBLE_EQ(venting.vent_flow,
                   0.5 * restriction(rig, rig.valve.conductance_m3_per_s_Pa).conductance_kg_per_s_Pa * 4e5);
  EXPECT_GT(half.hose_flow, 0.0);
  EXPECT_EQ(half.hose_flow, venting.hose_flow);
}

TEST(ValveFlow, ARegulatorsPressureFollowsItsErrorWithTheLagThatIsSaid) {
  Rig rig;
  rig.valve.kind = ValveKind::regulator;
  rig.valve.time_constant_s = 0.4;
  rig.valve.conductance_m3_per_s_Pa = 1e-7;
  rig.valve.dead_band_Pa = 1e3;
  const ValveFlow flow(rig);
  EXPECT_NEAR(flow.pressure_rate_Pa_per_s(at(rig, 1e4)), (1e4 - 1e3) / 0.4, 1e-6);
  EXPECT_NEAR(flow.pressure_rate_Pa_per_s(at(rig, 0.9e3)), 0.0, 1e-6);
  // Of a gas that warms as it is pressed less is wanted for it.
  rig.effects.get<PolytropicGas>().exponent = 1.4;
  EXPECT_NEAR(flow.pressure_rate_Pa_per_s(at(rig, 1e4, &rig.effects)) * 1.4, (1e4 - 1e3) / 0.4, 1e-6);
}

TEST(ValveFlow, ValvesThatAreOpenOrShutLeakOnlyWhileTheyAreShut) {
  Rig rig;
  rig.valve.kind = ValveKind::on_off;
  const auto through = [&](double fills, double vents) {
    return ValveFlow(rig).switched(ends, SideMemory<double>{}, HeldSide{.fills = fills, .vents = vents},
                                   nullptr);
  };
  EXPECT_EQ(through(0.0, 0.0).supply_flow, 0.0);
  const double open = through(1.0, 0.0).supply_flow;
  rig.valve.leak_m3_per_s_Pa = 0.01 * rig.valve.conductance_m3_per_s_Pa;
  EXPECT_NEAR(through(0.0, 1.0).supply_flow, 0.01 * open, 1e-12 * open);
  EXPECT_EQ(through(1.0, 1.0).supply_flow, open);
  EXPECT_GT(through(1.0, 1.0).vent_flow, through(1.0, 0.0).vent_flow);
}

TEST(ValveFlow, WhatKeepsAGivenPressureBringsWhatTheHoseTakesAndTheRise) {
  const Rig rig;
  const ValveFlow flow(rig);
  const auto now = flow.kept(ends, HeldSide{.pressure_rate_Pa_per_s = 2e5}, nullptr);
  EXPECT_NEAR(flow.pressure_rate_Pa_per_s(now), 2e5, 1e-6);
}

}  // namespace
}  // namespace mckibben::plant
