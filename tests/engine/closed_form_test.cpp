// Motions with a known answer, for both methods: choked filling, free fall, and what a run must conserve.
#include <cmath>

#include <gtest/gtest.h>

#include "rig_on_bench.hpp"

namespace mckibben::engine {
namespace {

class ClosedForm : public testing::TestWithParam<Method> {};

TEST_P(ClosedForm, ChokedFillingIsLinear) {
  plant::Rig rig;
  rig.hose.conductance_m3_per_s_Pa = 1e-12;  // as good as shut
  rig.valve.supply_pressure_Pa = 20e5;       // choked up to 5.3 bar of gauge pressure
  RigOnBench bench(rig, 10.0, {GetParam(), 1e-9});
  bench.start(4.0);
  bench.hold(20.0);  // still more than a proportional band away: fully open
  const double flow_kg_per_s = 4e-9 * 1.185 * (20e5 + 101325.0);
  const double expected_Pa = 0.5e5 + 287.05 * 293.15 / 5e-5 * flow_kg_per_s * 0.012;
  EXPECT_LT(expected_Pa, 5e5 - 0.3e5);
  EXPECT_NEAR(bench.flow.state.side.valve_pressure_Pa, expected_Pa, 1e-4 * expected_Pa);
}

TEST_P(ClosedForm, AnEmptyMuscleLetsTheLoadFallFreely) {
  plant::Rig rig;
  rig.muscle.rest_radius_m = 5e-4;  // a thread: its pull is a few millionths of the weight
  rig.valve.zero_pressure_Pa = 0.0;
  rig.friction.memory = plant::FrictionMemory::coulomb;  // with next to no level
  rig.friction.scale = 0.0;
  rig.friction.floor_N = 1e-3;
  rig.joint.guide_damping_N_s_per_m = 0.0;
  rig.joint.wheel_inertia_kg_m2 = 0.0;
  RigOnBench bench(rig, 400.0, {GetParam(), 1e-9});
  bench.start(4.0);
  bench.flow.state.joint.contraction_ratio = 0.28;
  bench.held.slip = plant::Slip::falling;
  bench.hold(4.0, 10);
  const double t = 0.12;
  EXPECT_NEAR(bench.flow.state.joint.contraction_ratio, 0.28 - 0.5 * 9.80665 * t * t / 0.3, 2e-5);
  EXPECT_NEAR(bench.flow.state.joint.contraction_speed_per_s, -9.80665 * t / 0.3, 2e-4);
}

TEST_P(ClosedForm, GasMassAndEnergyAreConserved) {
  RigOnBench bench(plant::Rig{}, 13.87, {GetParam(), 1e-10}, true);
  bench.start(4.0);
  const double gas_before_kg = bench.plant.gas_mass_kg(bench.flow.state);
  const double energy_before_J = bench.plant.mechanical_energy_J(bench.flow.state);
  for (int k = 0; k < 600; ++k) bench.hold(12.0 - 8.0 * std::cos(0.03 * k) + (k % 90 > 60 ? 3.0 : 0.0));
  const auto& books = bench.flow.ledger;
  EXPECT_GT(books.air_drawn_kg, 1e-4);
  EXPECT_NEAR(bench.plant.gas_mass_kg(bench.flow.state) - gas_before_kg,
              books.air_drawn_kg - books.air_vented_kg, 1e-8 * books.air_drawn_kg);
  EXPECT_GT(books.thread_friction_work_J, 0.1);
  EXPECT_NEAR(books.braid_work_J + books.stop_work_J - books.thread_friction_work_J - books.guide_work_J,
              bench.plant.mechanical_energy_J(bench.flow.state) - energy_before_J,
              1e-7 * books.thread_friction_work_J);
}

INSTANTIATE_TEST_SUITE_P(BothMethods, ClosedForm, testing::Values(Method::erk, Method::cvode),
                         [](const auto& p) { return p.param == Method::erk ? "erk" : "cvode"; });

}  // namespace
}  // namespace mckibben::engine
