// Regulators in motion: the lag that is said is the lag that comes out, as closed forms have it; flow limits,
// dead band, gas books, Jacobian.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "regulators.hpp"
#include "rig_on_bench.hpp"
#include "slopes.hpp"

namespace mckibben::engine {
namespace {

class Regulator : public testing::TestWithParam<Method> {};

TEST_P(Regulator, FollowsAStepWithItsTimeConstant) {
  RigOnBench bench(plant::quick_regulator(0.2), 13.87, {GetParam(), 1e-9});
  bench.start(4.0);
  bench.hold(8.0, 25);  // 0.3 s; within what flows
  const double to_Pa = bench.held.reference_pressure_Pa;
  EXPECT_NEAR(bench.flow.state.side.valve_pressure_Pa, to_Pa + (0.5e5 - to_Pa) * std::exp(-1.5), 2.0);
}

TEST_P(Regulator, SwingsAsItsFrequencyAndDampingSay) {
  const double f = 2.0, D = 0.4, w = 2.0 * std::numbers::pi * f, d = w * std::sqrt(1.0 - D * D);
  RigOnBench bench(plant::swinging_regulator(f, D), 13.87, {GetParam(), 1e-9});
  bench.start(4.0);
  for (int i = 0; i < 40; ++i) {
    bench.hold(6.0);
    const double t = 0.012 * bench.tick, to_Pa = bench.held.reference_pressure_Pa;
    const double left = std::exp(-D * w * t) * (std::cos(d * t) + D * w / d * std::sin(d * t));
    ASSERT_NEAR(bench.flow.state.side.valve_pressure_Pa, to_Pa + (0.5e5 - to_Pa) * left, 3.0) << t;
  }
}

TEST_P(Regulator, GivesNoMoreThanItsConductances) {
  plant::Rig rig = plant::quick_regulator(1e-3);
  rig.hose.conductance_m3_per_s_Pa = 1e-12;  // as good as shut
  rig.valve.supply_pressure_Pa = 20e5;       // choked up to 5.3 bar of gauge pressure
  rig.valve.venting_conductance_m3_per_s_Pa = 1e-9;
  RigOnBench bench(rig, 10.0, {GetParam(), 1e-9});
  bench.start(4.0);
  bench.hold(20.0);
  const double per_kg = 287.05 * 293.15 / 5e-5;
  const double filled_Pa = 0.5e5 + per_kg * 4e-9 * 1.185 * (20e5 + 101325.0) * 0.012;
  EXPECT_NEAR(bench.flow.state.side.valve_pressure_Pa, filled_Pa, 1e-4 * filled_Pa);
  bench.hold(4.0);  // choked venting empties the volume as exp(-t C rho R T/V)
  const double left_Pa = (filled_Pa + 101325.0) * std::exp(-per_kg * 1e-9 * 1.185 * 0.012) - 101325.0;
  EXPECT_NEAR(bench.flow.state.side.valve_pressure_Pa, left_Pa, 1e-4 * left_Pa);
}

TEST_P(Regulator, DoesNothingWithinItsDeadBand) {
  plant::Rig rig = plant::quick_regulator(0.02);
  rig.valve.dead_band_Pa = 2e3;
  RigOnBench bench(rig, 13.87, {GetParam(), 1e-9});
  bench.start(8.0);
  bench.hold(8.0, 300);
  const double before_Pa = bench.flow.state.side.valve_pressure_Pa;
  bench.hold(8.05, 50);  // 1.4 kPa
  EXPECT_NEAR(bench.flow.state.side.valve_pressure_Pa, before_Pa, 0.1);
  bench.hold(8.5, 50);
  EXPECT_NEAR(bench.held.reference_pressure_Pa - bench.flow.state.side.valve_pressure_Pa, 2e3, 1.0);
}

TEST_P(Regulator, KeepsTheBooksOfItsGas) {
  for (const bool polytropic : {false, true}) {
    plant::Rig rig = plant::swinging_regulator(3.0, 0.5);
    if (polytropic) rig.effects.get<plant::PolytropicGas>().exponent = 1.2;
    RigOnBench bench(rig, 13.87, {GetParam(), 1e-10}, true);
    bench.start(4.0);
    const auto before = bench.flow.state;
    for (int k = 0; k < 300; ++k) bench.hold(12.0 - 8.0 * std::cos(0.05 * k) + (k % 90 > 60 ? 3.0 : 0.0));
    EXPECT_GT(bench.flow.ledger.air_drawn_kg, 1e-4);
    const auto open = bench.plant.imbalance(before, bench.flow.state, bench.flow.ledger);
    EXPECT_LT(open.gas, 1e-8) << polytropic;
    EXPECT_LT(open.energy, 1e-6) << polytropic;
  }
}

INSTANTIATE_TEST_SUITE_P(BothMethods, Regulator, testing::Values(Method::erk, Method::cvode),
                         [](const auto& p) { return p.param == Method::erk ? "erk" : "cvode"; });

TEST(Jacobian, KnowsRegulators) {
  plant::Rig banded = plant::quick_regulator(0.1);
  banded.valve.dead_band_Pa = 1e3;
  expect_slopes<Layout<1, plant::Memories::none, Books::isothermal>>(banded);
  expect_slopes<Layout<1, plant::Memories::few, Books::polytropic>>(plant::swinging_regulator(5.0, 0.7));
  expect_slopes<Layout<2, plant::Memories::few, Books::none>>(plant::swinging_regulator(5.0, 0.7));
}

}  // namespace
}  // namespace mckibben::engine
