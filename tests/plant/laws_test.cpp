// Flow, friction level and valve line against their closed forms.
#include <cmath>

#include <gtest/gtest.h>

#include <plant/flow.hpp>
#include <plant/friction.hpp>
#include <plant/plant.hpp>

namespace mckibben::plant {
namespace {

TEST(Flow, IsChokedBelowTheCriticalRatio) {
  const Restriction valve{4e-9 * 1.185, 0.3, 1e3};
  EXPECT_DOUBLE_EQ(valve.flow_kg_per_s(7e5, 1e5), 4e-9 * 1.185 * 7e5);
  EXPECT_DOUBLE_EQ(valve.flow_kg_per_s(7e5, 2e5), valve.flow_kg_per_s(7e5, 1e5));
  EXPECT_NEAR(valve.flow_kg_per_s(7e5, 0.3 * 7e5), 4e-9 * 1.185 * 7e5, 1e-15);
}

TEST(Flow, FollowsTheEllipseAboveIt) {
  const Restriction valve{1e-8, 0.3, 1e3};
  const double ratio = 0.8;
  EXPECT_NEAR(valve.flow_kg_per_s(5e5, ratio * 5e5),
              1e-8 * 5e5 * std::sqrt(1 - std::pow((ratio - 0.3) / 0.7, 2)), 1e-14);
}

TEST(Flow, IsLinearForSmallDifferencesAndContinuous) {
  const Restriction hose{1e-8, 0.3, 1e3};
  EXPECT_NEAR(hose.flow_kg_per_s(3e5, 3e5 - 500.0), 0.5 * hose.flow_kg_per_s(3e5, 3e5 - 1000.0), 1e-16);
  EXPECT_NEAR(hose.flow_kg_per_s(3e5, 3e5 - 1000.0001), hose.flow_kg_per_s(3e5, 3e5 - 999.9999), 1e-9);
  EXPECT_EQ(hose.flow_kg_per_s(3e5, 3e5), 0.0);
}

TEST(Flow, RunsBackAsItRunsForth) {
  const Restriction hose{1e-8, 0.3, 1e3};
  for (const double low : {1e5, 2.9e5, 2.9995e5})
    EXPECT_EQ(hose.flow_kg_per_s(3e5, low), -hose.flow_kg_per_s(low, 3e5));
}

TEST(FrictionLevel, IsTheThesissSuperposition) {
  const Friction friction;
  const double e = 0.15, S = 0.01, P = 3e5;
  const double f = 0.01 * (4.6937 - 13.9715 * e + 0.5306 * std::log(e));
  EXPECT_NEAR(friction_level_N(friction, e, S, P, 0.0), f * S * P + 1.0, 1e-9);
  Friction faster = friction;
  faster.f1_s2_per_mA2 = 0.002;
  EXPECT_NEAR(friction_level_N(faster, e, S, P, 10.0) - friction_level_N(friction, e, S, P, 0.0),
              0.01 * 0.2 * S * P, 1e-9);
}

TEST(FrictionLevel, ClampsTheContractionItUses) {
  const Friction friction;
  EXPECT_EQ(friction_coefficient(friction, -0.1, 0.0), friction_coefficient(friction, 0.005, 0.0));
  EXPECT_EQ(friction_coefficient(friction, 0.4, 0.0), friction_coefficient(friction, 0.28, 0.0));
}

TEST(FrictionLevel, OtherLawsOfTextileFibres) {
  Friction friction;
  const double S = 0.01, P = 2e5, N = S * P;
  friction.law = FrictionLaw::area;
  friction.adhesion_Pa = 100.0;
  EXPECT_NEAR(friction_level_N(friction, 0.1, S, P, 0.0), 0.015 * N + 100.0 * S + 1.0, 1e-9);  // T 1.1
  friction.law = FrictionLaw::logarithmic;
  EXPECT_NEAR(friction_level_N(friction, 0.1, S, P, 0.0), N * (0.05 - 0.004 * std::log(N)) + 1.0,
              1e-9);  // T 1.2
  friction.law = FrictionLaw::power;
  EXPECT_NEAR(friction_level_N(friction, 0.1, S, P, 0.0), 0.005 * N + 0.05 * std::pow(N, 0.8) + 1.0,
              1e-9);  // T 1.3
}

TEST(FrictionLevel, NeverFallsBelowItsFloor) {
  Friction friction;
  for (const auto law :
       {FrictionLaw::superposition, FrictionLaw::area, FrictionLaw::logarithmic, FrictionLaw::power}) {
    friction.law = law;
    for (const double P : {-5e4, 0.0, 1e-9, 1.0, 5e5, 5e8})
      EXPECT_GE(friction_level_N(friction, 0.2, 0.01, P, 0.0), friction.floor_N) << P;
  }
}

TEST(Valve, FollowsItsTrimmedLine) {
  const Plant plant(Rig{}, 10.0);
  EXPECT_DOUBLE_EQ(plant.reference_pressure_Pa(0.0), 0.5e5);  // below 4 mA it stays
  EXPECT_DOUBLE_EQ(plant.reference_pressure_Pa(4.0), 0.5e5);
  EXPECT_DOUBLE_EQ(plant.reference_pressure_Pa(12.0), 2.75e5);
  EXPECT_DOUBLE_EQ(plant.reference_pressure_Pa(20.0), 5.0e5);
  EXPECT_DOUBLE_EQ(plant.reference_pressure_Pa(25.0), 5.0e5);
}

TEST(Plant, WarmGasFlowsLess) {
  Held held;
  held.reference_pressure_Pa = 5e5;
  const State<double> state{{0.1, 0.0}, {1e5, 1e5, 0.0}, {}};
  Rig warm;
  warm.gas.temperature_K = 4.0 * 293.15 / 3.0;
  const double nominal = Plant(Rig{}, 10.0).moment(state, held).supply_flow;
  EXPECT_NEAR(Plant(warm, 10.0).moment(state, held).supply_flow, nominal * std::sqrt(0.75), 1e-12 * nominal);
}

TEST(Plant, BalancesGravityAndInertia) {
  const Plant plant(Rig{}, 10.0);
  State<double> state{{0.1, 0.5}, {2e5, 2e5, 1e-5}, {}};
  Held held;
  held.reference_pressure_Pa = 2e5;
  const auto now = plant.moment(state, held);
  EXPECT_NEAR(now.acceleration_m_per_s2 * (10.0 + 1e-4 / (0.03 * 0.03)),
              now.braid_force_N + now.friction_force_N - 10.0 * 9.80665 - 20.0 * 0.15, 1e-9);
  EXPECT_EQ(now.valve_opening, 0.0);
  EXPECT_EQ(now.stop_force_N, 0.0);
}

TEST(Plant, SlidingThreadsPullWithTheFrictionLevel) {
  const Plant plant(Rig{}, 10.0);
  State<double> state{{0.1, 0.5}, {2e5, 2e5, 0.0}, {}};
  state.side.bristle_m = plant.moment(state, Held{}).friction_level_N / 4e5;  // dz/dt = 0 while v > 0
  const auto now = plant.moment(state, Held{});
  EXPECT_NEAR(now.bristle_rate_m_per_s, 0.0, 1e-15);
  EXPECT_NEAR(now.friction_force_N, -now.friction_level_N, 1e-9);
}

TEST(Plant, TautThreadsOnlyPush) {
  const Plant plant(Rig{}, 10.0);
  State<double> state{{-0.001, 0.0}, {0.0, 0.0, 0.0}, {}};
  EXPECT_NEAR(plant.moment(state, Held{}).stop_force_N, 3e5 * 0.0003, 1e-9);
  state.joint.contraction_speed_per_s = 10.0;  // leaving fast: damping must not turn into a pull
  EXPECT_EQ(plant.moment(state, Held{}).stop_force_N, 0.0);
}

}  // namespace
}  // namespace mckibben::plant
