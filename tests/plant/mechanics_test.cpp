// What moves: muscles side by side, a return spring, and two muscles of a pair: what the second side takes
// from the first, and what cannot be.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "chance.hpp"

namespace mckibben::plant {
namespace {

/// A rig with effects that pull at the muscle, at the load, leak and press; and one with such muscles.
Rig beset() {
  Rig rig;
  rig.effects.get<ViscousDamping>().damping_N_s_per_m = 30.0;
  rig.effects.get<GuideFriction>().coefficient = 0.02;
  rig.effects.get<MuscleLeak>().conductance_m3_per_s_Pa = 1e-10;
  rig.effects.get<PressureThreshold>().pressure_Pa = 1e4;
  rig.effects.get<SpeedDependentFriction>().ratio = 0.7;
  rig.effects.get<IsometricHysteresis>().pressure_Pa = 1.5e4;
  return rig;
}

// Whatever the law of friction: n muscles pull and take n times as much as one at the same length, speed and
// pressures, and their bristles and pressures change as its do where the valve gives n times as much.
TEST(Mechanics, MusclesSideBySidePullTogetherAsOneEach) {
  constexpr double n = 3.0;
  Chance chance;
  for (const auto& [law, name] : names(FrictionLaw{})) {
    Rig one = beset();
    one.friction.law = law;
    Rig three = one;
    three.muscle.count = 3;
    for (int i = 0; i < 20; ++i) {
      const State<double> state{{chance.between(-0.005, 0.25), chance.between(-2.0, 2.0)},
                                {chance.between(0.5e5, 5e5), chance.between(0.5e5, 5e5), 1e-5},
                                {}};
      const Memory<double> memory = chance.memory();
      Held held;
      held.reference_pressure_Pa = 3e5;
      const Plant alone(one, 10.0), together(three, 10.0);
      const auto a = alone.moment(state, memory, held), b = together.moment(state, memory, held);
      const auto times_n = [&, law = name](double of_one, double of_three) {
        EXPECT_NEAR(of_three, n * of_one, 1e-12 * (1e-9 + std::abs(n * of_one))) << law;
      };
      times_n(a.braid_force_N, b.braid_force_N);
      times_n(a.stop_force_N, b.stop_force_N);
      times_n(a.friction_level_N, b.friction_level_N);
      times_n(a.friction_force_N, b.friction_force_N);
      times_n(a.effects_pull_N - a.pull_on_load_N, b.effects_pull_N - b.pull_on_load_N);
      times_n(a.volume_m3, b.volume_m3);
      times_n(a.hose_flow, b.hose_flow);
      times_n(a.leak_flow, b.leak_flow);
      EXPECT_EQ(a.pull_on_load_N, b.pull_on_load_N);
      EXPECT_EQ(a.supply_flow, b.supply_flow);
      const auto of_one = alone.rates(state, a).side, of_three = together.rates(state, b).side;
      EXPECT_NEAR(of_one.muscle_pressure_Pa, of_three.muscle_pressure_Pa, 1e-9 * 1e6);
      EXPECT_NEAR(of_one.bristle_m, of_three.bristle_m, 1e-12);
    }
  }
}

TEST(Mechanics, ASpringOfOneWayOnlyPulls) {
  Joint joint{.spring_N_per_m = 4000.0, .spring_preload_N = -20.0};
  EXPECT_DOUBLE_EQ(joint.spring().pull(0.002), -12.0);
  EXPECT_DOUBLE_EQ(joint.spring().pull(0.010), 20.0);
  EXPECT_DOUBLE_EQ(joint.spring().energy_J(0.010), 0.5 * 4000.0 * 1e-4 - 20.0 * 0.010);
  joint.spring_ways = SpringWays::one;
  EXPECT_DOUBLE_EQ(joint.spring().pull(0.002), 0.0);
  EXPECT_DOUBLE_EQ(joint.spring().pull(0.010), 20.0);
  EXPECT_DOUBLE_EQ(joint.spring().energy_J(0.002), 0.0);
  EXPECT_DOUBLE_EQ(joint.spring().energy_J(0.010), 0.5 * 4000.0 * 0.005 * 0.005);
}

TEST(Mechanics, ALoadHangsWhereItPullsAndSomethingMoves) {
  Rig rig;
  EXPECT_TRUE(rig.can_hang(0.0));  // the wheel moves
  rig.joint.wheel_inertia_kg_m2 = 0.0;
  EXPECT_FALSE(rig.can_hang(0.0));
  EXPECT_TRUE(rig.can_hang(0.1));
  rig.joint.moving_mass_kg = 0.3;
  EXPECT_TRUE(rig.can_hang(0.0));
  EXPECT_DOUBLE_EQ(Plant(rig, 0.0).moved_kg(), 0.3);
  EXPECT_EQ(Plant(rig, 0.0).weight_N(), 0.0);
  rig.joint.load_offset_kg = -0.2;
  EXPECT_FALSE(rig.can_hang(0.1));
}

// Of a pair its rise counts from joint angle 0; the pull is the cord's of muscle 1.
TEST(Mechanics, ASpringTurnsAPairBack) {
  Rig rig = thesis_pair();
  rig.joint.spring_N_per_m = 2000.0;
  rig.joint.spring_preload_N = 15.0;
  const Plant plant = plant_of(rig);
  EXPECT_DOUBLE_EQ(plant.spring_force_N(0.1), -15.0);
  EXPECT_NEAR(plant.spring_force_N(0.1 + 0.01 / 0.3), -35.0, 1e-9);
}

std::vector<std::string> broken(Rig rig, const Pair& pair) {
  std::vector<std::string> found;
  const auto report = [&](std::string_view, std::string_view message) { found.emplace_back(message); };
  pair.rules(report);
  rig.mechanics = pair;
  rig.rules(report);
  return found;
}

TEST(Mechanics, TheSecondSideHasItsOwnPartsAndSharesTheRest) {
  Rig rig;
  rig.gas.temperature_K = 300.0;
  rig.muscle.rest_radius_m = 8e-3;
  Pair pair;
  pair.opposite = side_of(rig);
  pair.opposite.hose.conductance_m3_per_s_Pa = 1e-8;
  Rig both = rig;
  both.mechanics = pair;
  const Rig other = opposite_rig(both);
  EXPECT_EQ(other.muscle.rest_radius_m, 8e-3);
  EXPECT_EQ(other.gas.temperature_K, 300.0);
  EXPECT_EQ(other.hose.conductance_m3_per_s_Pa, 1e-8);
  EXPECT_TRUE(broken(rig, pair).empty());
}

TEST(Mechanics, WhatTwoSidesCannotBeIsSaid) {
  const Rig rig;
  const auto with = [&](const auto& change) {
    Pair pair;
    change(pair);
    return broken(rig, pair);
  };
  const auto one = [](const std::vector<std::string>& found, const char* word) {
    ASSERT_EQ(found.size(), 1u) << word;
    EXPECT_NE(found.front().find(word), std::string::npos) << found.front();
  };
  one(with([](Pair& pair) { pair.opposite.friction.memory = FrictionMemory::coulomb; }), "friction.memory");
  one(with([](Pair& pair) { pair.opposite.effects.get<PolytropicGas>().exponent = 1.2; }), "polytropic_gas");
  one(with([](Pair& pair) { pair.opposite.valve.supply_pressure_Pa = 7e5; }), "supply_pressure");
  one(with([](Pair& pair) { pair.opposite.effects.get<GuideFriction>().coefficient = 0.1; }), "guide");
  one(with([](Pair& pair) { pair.contraction_ratio = 0.3; }), "contraction_1");
  one(with([](Pair& pair) { pair.opposite_contraction_ratio = 0.3; }), "contraction_2");
  one(with([](Pair& pair) { pair.inertia_kg_m2 = 0.1; }), "parallel axes");
  one(with([](Pair& pair) { pair.opposite.valve.volume_m3 = 1e-7, pair.opposite.hose.linear_zone_Pa = 1.0; }),
      "side of muscle 2");
}

}  // namespace
}  // namespace mckibben::plant
