// What a rig file may say of two muscles: what the second side takes from the first, and what cannot be.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <plant/rig.hpp>

namespace mckibben::plant {
namespace {

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
