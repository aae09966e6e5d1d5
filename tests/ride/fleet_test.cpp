// Rigs stepped together from outside: each goes where it goes alone, whatever rides beside it.
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/ride/fleet.hpp>

#include "switched_on.hpp"

namespace mckibben::ride {
namespace {

constexpr double pace_s = 0.012;
constexpr int paces = 200;

double wave_mA(std::size_t rig, int k) {
  return 11.0 - 6.0 * std::cos(0.05 * k + 0.3 * static_cast<double>(rig));
}

struct Members {
  std::vector<Hanging> rigs;
  std::vector<solver::Settings> settings;

  void add(const plant::Rig& rig, double load_kg, const solver::Settings& with = {}) {
    rigs.push_back({rig, load_kg});
    settings.push_back(with);
  }
};

/// Twenty of the thesis's, and one each that rides alone, remembers, hears late, or is stiff.
Members mixed(double tolerance) {
  Members party;
  for (int i = 0; i < 20; ++i) party.add({}, 8.0 + i, {solver::Method::automatic, tolerance});
  plant::Rig coulomb, late, creeping, stiff;
  coulomb.friction.memory = plant::FrictionMemory::coulomb;
  late.effects.get<plant::CommandDelay>().time_s = 0.017;
  plant::switch_on(creeping.effects.get<plant::BladderCreep>(), plant::BladderCreep::variants.front());
  stiff.valve.volume_m3 = 2e-8;
  for (const plant::Rig& rig : {coulomb, late, creeping, stiff})
    party.add(rig, 14.0, {solver::Method::automatic, tolerance});
  party.add({}, 14.0, {solver::Method::cvode, tolerance});
  return party;
}

Fleet ridden(const Members& party, std::size_t first = 0) {
  Fleet fleet(party.rigs, party.settings);
  std::vector<double> currents(party.rigs.size());
  for (int k = 0; k < paces; ++k) {
    for (std::size_t i = 0; i < currents.size(); ++i) currents[i] = wave_mA(first + i, k);
    if (k == 0) fleet.start(currents, 0.0);
    fleet.step(currents, pace_s * (k + 1));
  }
  return fleet;
}

TEST(Fleet, EachRigGoesWhereItGoesAlone) {
  const Members party = mixed(solver::tightest_tolerance);
  const Fleet fleet = ridden(party);
  for (std::size_t i = 0; i < party.rigs.size(); ++i) {
    Ride alone(party.rigs[i], party.settings[i]);
    alone.start({{.current_mA = wave_mA(i, 0)}, {}, {}}, 0.0);
    for (int k = 0; k < paces; ++k) alone.step({{.current_mA = wave_mA(i, k)}, {}, {}}, pace_s * (k + 1));
    const auto& there = fleet.rider(i).now.flow.state;
    EXPECT_EQ(fleet.failure(i), "");
    EXPECT_NEAR(there.joint.contraction_ratio, alone.flow().state.joint.contraction_ratio, 1e-9) << i;
    EXPECT_NEAR(there.side.muscle_pressure_Pa, alone.flow().state.side.muscle_pressure_Pa, 1e-3) << i;
    EXPECT_EQ(fleet.rider(i).now.time_s, alone.time_s());
    EXPECT_GT(there.joint.contraction_ratio, 0.01) << i;
  }
}

TEST(Fleet, WhatRidesBesideARigMakesNoDifference) {
  const Members all = mixed(1e-6);
  Members some;
  for (std::size_t i = 17; i < all.rigs.size(); ++i)
    some.add(all.rigs[i].rig, all.rigs[i].load_kg, all.settings[i]);
  const Fleet many = ridden(all), few = ridden(some, 17);
  for (std::size_t i = 0; i < some.rigs.size(); ++i) {
    const auto &a = many.rider(17 + i).now.flow, &b = few.rider(i).now.flow;
    EXPECT_EQ(std::memcmp(&a.state, &b.state, sizeof a.state), 0) << i;
    EXPECT_EQ(std::memcmp(&a.memory, &b.memory, sizeof a.memory), 0) << i;
  }
}

TEST(Fleet, ARigThatFailsFailsAlone) {
  Members party;
  plant::Rig soft;  // its load falls past the range of the laws
  soft.muscle.stop_stiffness_N_per_m = 1e3;
  soft.muscle.stop_damping_s_per_m = 0.0;
  party.add({}, 11.138);
  party.add(soft, 400.0);
  party.add({}, 11.138);
  const Fleet fleet = ridden(party);
  EXPECT_NE(fleet.failure(1).find("e"), std::string::npos);
  EXPECT_LT(fleet.rider(1).now.time_s, fleet.time_s());
  EXPECT_EQ(fleet.failure(0) + fleet.failure(2), "");
  EXPECT_EQ(fleet.rider(2).now.time_s, fleet.time_s());
}

TEST(Fleet, RefusesWhatCannotBe) {
  Members party;
  party.add({}, 11.138);
  EXPECT_THROW(Fleet(party.rigs, {}), std::invalid_argument);
  Fleet fleet(party.rigs, party.settings);
  const std::vector<double> one{8.0}, two{8.0, 8.0};
  EXPECT_THROW(fleet.start(two, 0.0), std::invalid_argument);
  fleet.start(one, 0.0);
  EXPECT_THROW(fleet.step(two, 1.0), std::invalid_argument);
  EXPECT_THROW(fleet.step(one, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::ride
