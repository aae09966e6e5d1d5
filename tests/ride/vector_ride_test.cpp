// Rigs stepped together from outside: each goes where it goes alone, whatever the others are.
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/ride/vector_ride.hpp>

#include "switched_on.hpp"

namespace mckibben::ride {
namespace {

constexpr double pace_s = 0.012;
constexpr int paces = 200;

double wave_mA(std::size_t rig, int k) {
  return 11.0 - 6.0 * std::cos(0.05 * k + 0.3 * static_cast<double>(rig));
}

struct Members {
  std::vector<Loaded> rigs;
  std::vector<solver::Settings> settings;

  void add(const plant::Rig& rig, double mass_kg, const solver::Settings& with = {}) {
    rigs.push_back({rig, mass_kg});
    settings.push_back(with);
  }
};

/// Twenty of the thesis's, and one each that goes alone, has memory, a late command, or is stiff.
Members mixed(double tolerance) {
  Members members;
  for (int i = 0; i < 20; ++i) members.add({}, 8.0 + i, {solver::Method::automatic, tolerance});
  plant::Rig coulomb, late, creeping, stiff;
  coulomb.friction.memory = plant::FrictionMemory::coulomb;
  late.effects.get<plant::CommandDelay>().time_s = 0.017;
  plant::switch_on(creeping.effects.get<plant::BladderCreep>(), plant::BladderCreep::variants.front());
  stiff.valve.volume_m3 = 2e-8;
  for (const plant::Rig& rig : {coulomb, late, creeping, stiff})
    members.add(rig, 14.0, {solver::Method::automatic, tolerance});
  members.add({}, 14.0, {solver::Method::cvode, tolerance});
  return members;
}

VectorRide ridden(const Members& members, std::size_t first = 0) {
  VectorRide rides(members.rigs, members.settings);
  std::vector<double> currents(members.rigs.size());
  for (int k = 0; k < paces; ++k) {
    for (std::size_t i = 0; i < currents.size(); ++i) currents[i] = wave_mA(first + i, k);
    if (k == 0) rides.start(currents, 0.0);
    rides.step(currents, pace_s * (k + 1));
  }
  return rides;
}

TEST(VectorRide, EachRigGoesWhereItGoesAlone) {
  const Members members = mixed(solver::tightest_tolerance);
  const VectorRide rides = ridden(members);
  for (std::size_t i = 0; i < members.rigs.size(); ++i) {
    Ride alone(members.rigs[i], members.settings[i]);
    alone.start({{.current_mA = wave_mA(i, 0)}, {}, {}}, 0.0);
    for (int k = 0; k < paces; ++k) alone.step({{.current_mA = wave_mA(i, k)}, {}, {}}, pace_s * (k + 1));
    const auto& there = rides.rider(i).now.flow.state;
    EXPECT_EQ(rides.failure(i), "");
    EXPECT_NEAR(there.joint.contraction_ratio, alone.flow().state.joint.contraction_ratio, 1e-9) << i;
    EXPECT_NEAR(there.side.muscle_pressure_Pa, alone.flow().state.side.muscle_pressure_Pa, 1e-3) << i;
    EXPECT_EQ(rides.rider(i).now.time_s, alone.time_s());
    EXPECT_GT(there.joint.contraction_ratio, 0.01) << i;
  }
}

TEST(VectorRide, OtherRigsMakeNoDifference) {
  const Members all = mixed(1e-6);
  Members some;
  for (std::size_t i = 17; i < all.rigs.size(); ++i)
    some.add(all.rigs[i].rig, all.rigs[i].load_kg, all.settings[i]);
  const VectorRide many = ridden(all), few = ridden(some, 17);
  for (std::size_t i = 0; i < some.rigs.size(); ++i) {
    const auto &a = many.rider(17 + i).now.flow, &b = few.rider(i).now.flow;
    EXPECT_EQ(std::memcmp(&a.state, &b.state, sizeof a.state), 0) << i;
    EXPECT_EQ(std::memcmp(&a.memory, &b.memory, sizeof a.memory), 0) << i;
  }
}

TEST(VectorRide, GoesOnToTheSameBitsWhereverItIsSaved) {
  const Members members = mixed(1e-6);
  for (const int when : {0, 1, 20, 33}) {
    VectorRide rides(members.rigs, members.settings), resumed(members.rigs, members.settings);
    std::vector<double> currents(members.rigs.size());
    for (int k = 0; k < 80; ++k) {
      for (std::size_t i = 0; i < currents.size(); ++i) currents[i] = wave_mA(i, k);
      if (k == 0) rides.start(currents, 0.0);
      if (k == when) {
        std::vector<VectorRide::Saved> saved;
        for (std::size_t i = 0; i < currents.size(); ++i) saved.push_back(rides.save(i));
        resumed.resume(saved, rides.time_s());
      }
      rides.step(currents, pace_s * (k + 1));
      if (k >= when) resumed.step(currents, pace_s * (k + 1));
    }
    for (std::size_t i = 0; i < currents.size(); ++i) {
      const auto &a = rides.rider(i).now.flow, &b = resumed.rider(i).now.flow;
      EXPECT_EQ(std::memcmp(&a.state, &b.state, sizeof a.state), 0) << i << " saved at " << when;
      EXPECT_EQ(std::memcmp(&a.memory, &b.memory, sizeof a.memory), 0) << i << " saved at " << when;
    }
  }
}

TEST(VectorRide, ARigThatFailsFailsAlone) {
  Members members;
  plant::Rig soft;  // its load falls past the range of the laws
  soft.muscle.stop_stiffness_N_per_m = 1e3;
  soft.muscle.stop_damping_s_per_m = 0.0;
  members.add({}, 11.138);
  members.add(soft, 400.0);
  members.add({}, 11.138);
  const VectorRide rides = ridden(members);
  EXPECT_NE(rides.failure(1).find("e"), std::string::npos);
  EXPECT_LT(rides.rider(1).now.time_s, rides.time_s());
  EXPECT_EQ(rides.failure(0) + rides.failure(2), "");
  EXPECT_EQ(rides.rider(2).now.time_s, rides.time_s());
}

TEST(VectorRide, RefusesWhatCannotBe) {
  Members members;
  members.add({}, 11.138);
  EXPECT_THROW(VectorRide(members.rigs, {}), std::invalid_argument);
  VectorRide rides(members.rigs, members.settings);
  const std::vector<double> one{8.0}, two{8.0, 8.0};
  EXPECT_THROW(rides.start(two, 0.0), std::invalid_argument);
  rides.start(one, 0.0);
  EXPECT_THROW(rides.step(two, 1.0), std::invalid_argument);
  EXPECT_THROW(rides.step(one, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::ride
