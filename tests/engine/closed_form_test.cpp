// Motions with a known answer, for both methods: choked filling, free fall, return springs, muscles side by
// side, and what a run must conserve.
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

// Choked, a tank empties as exp(-n R T C rho0 t/V); isothermal, what it lost is drawn.
TEST_P(ClosedForm, ATankEmptiesByItsExponent) {
  for (const double n : {1.0, 1.4}) {
    plant::Rig rig;
    rig.hose.conductance_m3_per_s_Pa = 1e-12;  // as good as shut
    rig.valve.volume_m3 = 5e-4;
    rig.valve.supply_pressure_Pa = 20e5;
    auto& tank = rig.effects.get<plant::SupplyDroop>();
    tank.volume_m3 = 1e-4;
    tank.line_resistance_s_Pa_per_kg = 1e15;  // nothing refills it
    tank.exponent = n;
    RigOnBench bench(rig, 10.0, {GetParam(), 1e-9}, true);
    bench.start(4.0);
    bench.hold(20.0, 5);
    const double RT = 287.05 * 293.15, full_Pa = 20e5 + 101325.0;
    const double left_Pa = full_Pa * std::exp(-n * RT * 4e-9 * 1.185 * 0.06 / 1e-4);
    const double drop_Pa = bench.plant.side().rig().effects.supply_drop_Pa(bench.flow.memory.side);
    EXPECT_GT(drop_Pa, 4e5);
    EXPECT_NEAR(full_Pa - drop_Pa, left_Pa, 2e-5 * full_Pa) << n;
    EXPECT_NEAR(bench.flow.ledger.air_drawn_kg, 1e-4 * drop_Pa / (n * RT),
                1e-4 * bench.flow.ledger.air_drawn_kg);
  }
}

// A pump of a straight line: 1e-4 kg/s into an open outlet, 3 bar where it stalls, is a resistance of 3e9.
TEST_P(ClosedForm, APumpFillsItsTankAsExponentialsSay) {
  plant::Rig rig;
  rig.hose.conductance_m3_per_s_Pa = 1e-12;
  rig.valve.supply_pressure_Pa = 3e5;
  rig.valve.span_pressure_Pa = 3e5;
  auto& tank = rig.effects.get<plant::SupplyDroop>();
  tank.volume_m3 = 1e-3;
  tank.line_resistance_s_Pa_per_kg = 3e9;
  RigOnBench bench(rig, 10.0, {GetParam(), 1e-9});
  bench.start(4.0);
  bench.flow.memory.side.fill(2e5);  // 1 bar is left in it; nothing else remembers
  ASSERT_EQ(bench.plant.side().rig().effects.supply_drop_Pa(bench.flow.memory.side), 2e5);
  bench.hold(4.0, 100);
  const double drop_Pa = 2e5 * std::exp(-287.05 * 293.15 / 1e-3 / 3e9 * 1.2);
  EXPECT_NEAR(bench.plant.side().rig().effects.supply_drop_Pa(bench.flow.memory.side), drop_Pa, 10.0);
}

// Choked, what is vented falls as exp(-R T C rho0 t/V), below the atmosphere as well.
TEST_P(ClosedForm, AVacuumPumpEmptiesBelowTheAtmosphere) {
  plant::Rig rig;
  rig.hose.conductance_m3_per_s_Pa = 1e-12;
  rig.valve.zero_pressure_Pa = rig.valve.exhaust_pressure_Pa = -0.9e5;
  RigOnBench bench(rig, 10.0, {GetParam(), 1e-9});
  bench.start(20.0);
  bench.hold(4.0, 24);
  const double left_Pa = (5e5 + 101325.0) * std::exp(-287.05 * 293.15 * 1.185 * 4e-9 / 5e-5 * 0.288);
  EXPECT_LT(left_Pa, 0.7e5);
  EXPECT_NEAR(bench.flow.state.side.valve_pressure_Pa + 101325.0, left_Pa, 1e-3 * left_Pa);  // the hose leaks
  rig.hose.conductance_m3_per_s_Pa = 1.5e-8;
  RigOnBench whole(rig, 10.0, {GetParam(), 1e-9});
  whole.start(12.0);
  whole.hold(4.0, 2000);
  EXPECT_NEAR(whole.flow.state.side.muscle_pressure_Pa, -0.9e5, 100.0);
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

/// No load, next to no friction, a moving mass on a return spring.
plant::Rig on_a_spring(double N_per_m, double preload_N) {
  plant::Rig rig;
  rig.friction.scale = 0.0;
  rig.friction.floor_N = 1e-9;
  rig.friction.bristle_stiffness_N_per_m = 1e-6;  // as weak as the floor, or it is stiff
  rig.friction.bristle_damping_N_s_per_m = 0.0;
  rig.joint.wheel_inertia_kg_m2 = 0.0;
  rig.joint.moving_mass_kg = 0.3;
  rig.joint.spring_N_per_m = N_per_m;
  rig.joint.spring_preload_N = preload_N;
  return rig;
}

TEST_P(ClosedForm, AMuscleStandsWhereItsSpringBalancesIt) {
  for (const double pressure_Pa : {0.5e5, 1e5, 2e5, 4e5}) {
    RigOnBench bench(on_a_spring(4000.0, 20.0), 0.0, {GetParam(), 1e-9});
    bench.start(4.0);
    bench.held.given = plant::GivenPressure::muscle;
    bench.held.pressure_rate_Pa_per_s = 0.0;
    bench.flow.state.side.muscle_pressure_Pa = pressure_Pa;
    bench.hold(4.0, 200);
    const plant::Braid braid(plant::Muscle{});
    double low = 0.0, high = braid.largest_contraction_ratio();
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (braid.force_N(middle, pressure_Pa) > 20.0 + 4000.0 * 0.3 * middle ? low : high) = middle;
    }
    EXPECT_NEAR(300.0 * bench.flow.state.joint.contraction_ratio, 300.0 * low, 1e-6) << pressure_Pa;  // mm
  }
}

// x = x0 + a cos(sqrt(k/m) t)
TEST_P(ClosedForm, AMassSwingsOnItsSpring) {
  plant::Rig rig = on_a_spring(500.0, -15.0);  // at rest at 30 mm
  rig.muscle.rest_radius_m = 5e-4;             // a thread
  rig.valve.zero_pressure_Pa = 0.0;
  rig.joint.guide_damping_N_s_per_m = 0.0;
  RigOnBench bench(rig, 0.0, {GetParam(), 1e-10}, true);
  bench.start(4.0);
  bench.held.given = plant::GivenPressure::muscle;  // none, so that no gas is a second spring
  bench.flow.state.joint.contraction_ratio = 0.04 / 0.3;
  const auto before = bench.flow.state;
  bench.hold(4.0, 50);
  EXPECT_NEAR(0.3 * bench.flow.state.joint.contraction_ratio,
              0.03 + 0.01 * std::cos(std::sqrt(500.0 / 0.3) * 0.6), 2e-6);
  EXPECT_NEAR(bench.plant.mechanical_energy_J(bench.flow.state), bench.plant.mechanical_energy_J(before),
              1e-6);
}

// theta = theta0 cos(sqrt(m g L/I) t)
TEST_P(ClosedForm, ALinkOnEmptyMusclesIsAPendulum) {
  plant::Rig one = on_a_spring(0.0, 0.0);
  one.joint.moving_mass_kg = 0.0;
  plant::Link link;
  link.damping_N_m_s_per_rad = 0.0;
  const plant::Plant plant = plant::plant_of(plant::pair_of(one, one, link));
  const auto integrator = make_integrator(plant, {GetParam(), 1e-10}, false);
  plant::Held held;
  held.given = held.opposite.given = plant::GivenPressure::muscle;
  Flow flow;
  flow.state = plant.at_rest(held);  // no pressure
  flow.state.joint.contraction_ratio += 1e-3 * one.joint.wheel_radius_m / one.muscle.rest_length_m;
  const double per_s = std::sqrt(link.mass_kg * 9.80665 * link.length_m / link.inertia_kg_m2);
  for (int k = 0; k < 100; ++k) {
    integrator->advance(flow, held, 0.012 * k, 0.012 * (k + 1));
    EXPECT_NEAR(plant.angle_rad(flow.state.joint.contraction_ratio), 1e-3 * std::cos(per_s * 0.012 * (k + 1)),
                1e-8);
  }
}

TEST_P(ClosedForm, ASpringGivesBackWhatItTook) {
  for (const plant::SpringWays ways : {plant::SpringWays::both, plant::SpringWays::one}) {
    plant::Rig rig = on_a_spring(3000.0, -40.0);
    rig.joint.spring_ways = ways;
    RigOnBench bench(rig, 2.0, {GetParam(), 1e-10}, true);
    bench.start(4.0);
    const auto before = bench.flow.state;
    for (int k = 0; k < 200; ++k) bench.hold(12.0 - 8.0 * std::cos(0.06 * k));
    EXPECT_LT(bench.plant.imbalance(before, bench.flow.state, bench.flow.ledger).energy, 1e-7);
  }
}

// By hand for the law of superposition: force goes by the radius squared, threads and their level by the
// radius; the joint is of both.
TEST_P(ClosedForm, MusclesSideBySideAreOneThatIsScaledByHand) {
  const double n = 2.0;
  plant::Rig two, scaled;
  two.muscle.count = 2;
  two.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = 1e-10;
  scaled.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = n * 1e-10;
  scaled.muscle.rest_radius_m *= std::sqrt(n);
  scaled.muscle.dead_volume_m3 *= n;
  scaled.muscle.stop_stiffness_N_per_m *= n;
  scaled.friction.scale *= std::sqrt(n);
  scaled.friction.floor_N *= n;
  scaled.friction.bristle_stiffness_N_per_m *= n;
  scaled.friction.bristle_damping_N_s_per_m *= n;
  scaled.hose.conductance_m3_per_s_Pa *= n;
  RigOnBench one(two, 20.0, {GetParam(), 1e-9}), other(scaled, 20.0, {GetParam(), 1e-9});
  one.start(4.0);
  other.start(4.0);
  for (int k = 0; k < 200; ++k)
    for (RigOnBench* bench : {&one, &other}) bench->hold(12.0 - 8.0 * std::cos(0.06 * k));
  EXPECT_GT(one.flow.state.joint.contraction_ratio, 0.05);
  EXPECT_NEAR(one.flow.state.joint.contraction_ratio, other.flow.state.joint.contraction_ratio, 1e-8);
  EXPECT_NEAR(one.flow.state.side.muscle_pressure_Pa, other.flow.state.side.muscle_pressure_Pa, 0.1);
}

INSTANTIATE_TEST_SUITE_P(BothMethods, ClosedForm, testing::Values(Method::erk, Method::cvode),
                         [](const auto& p) { return p.param == Method::erk ? "erk" : "cvode"; });

}  // namespace
}  // namespace mckibben::engine
