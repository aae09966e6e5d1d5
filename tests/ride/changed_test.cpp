// A rig that is changed while it moves: what is not changed goes on to the same bits; memories that come are
// at rest, those that were there stay, plays and delays begin.
#include <cmath>

#include <gtest/gtest.h>

#include <sim/ride/changed.hpp>
#include <sim/ride/ride.hpp>

namespace mckibben::ride {
namespace {

constexpr double hung_kg = 16.138, change_tick_s = 0.012;

Drive slow_drive(int k) {
  return {{.current_mA = 10.0 - 4.0 * std::cos(0.03 * k)}};
}

Ride moving(const plant::Rig& rig, int ticks) {
  Ride ride(Loaded{rig, hung_kg}, {solver::Method::erk, 1e-8});
  ride.start(slow_drive(0), 0.0);
  for (int k = 0; k < ticks; ++k) ride.step(slow_drive(k), change_tick_s * (k + 1));
  return ride;
}

plant::Rig creeping(double stiffness_N_per_m) {
  plant::Rig rig;
  rig.effects.get<plant::BladderCreep>().stiffness_N_per_m = stiffness_N_per_m;
  return rig;
}

TEST(Changed, IntoItselfGoesOnAsItWould) {
  Ride ride = moving(creeping(100.0), 80);
  Ride other(changed(ride.rider(), Loaded{creeping(100.0), hung_kg}), {}, {solver::Method::erk, 1e-8});
  for (int k = 80; k < 160; ++k) {
    ride.step(slow_drive(k), change_tick_s * (k + 1));
    other.step(slow_drive(k), change_tick_s * (k + 1));
    ASSERT_NEAR(other.flow().state.joint.contraction_ratio, ride.flow().state.joint.contraction_ratio, 1e-8);
  }
}

TEST(Changed, AMemoryThatComesIsAtRestAndOneThatWasThereStays) {
  const Ride ride = moving(plant::Rig{}, 80);
  const Rider creeps = changed(ride.rider(), Loaded{creeping(100.0), hung_kg});
  EXPECT_EQ(creeps.now.flow.state.joint.contraction_ratio, ride.flow().state.joint.contraction_ratio);
  EXPECT_EQ(creeps.now.flow.state.side.bristle_m, ride.flow().state.side.bristle_m);
  EXPECT_NEAR(creeps.moment().effects_pull_N, 0.0, 1e-9) << "rubber that has given way does not pull";
  const Ride crept = moving(creeping(100.0), 80);
  ASSERT_GT(std::abs(crept.moment().effects_pull_N), 0.1);
  const Rider stiffer = changed(crept.rider(), Loaded{creeping(200.0), hung_kg});
  EXPECT_NEAR(stiffer.moment().effects_pull_N, 2.0 * crept.moment().effects_pull_N, 1e-9);
}

TEST(Changed, ADelayThatComesBeginsWithThePresentCommand) {
  const Ride ride = moving(plant::Rig{}, 80);
  plant::Rig late;
  late.effects.get<plant::CommandDelay>().time_s = 3 * change_tick_s;
  late.effects.get<plant::ReadingDelay>().time_s = 3 * change_tick_s;
  Ride other(changed(ride.rider(), Loaded{late, hung_kg}), {}, {solver::Method::erk, 1e-8});
  EXPECT_NEAR(other.reading().wheel_m, ride.reading().wheel_m, 1e-12);
  const double felt_Pa = ride.held().reference_pressure_Pa;
  other.hold(slow_drive(200), change_tick_s * 81);
  EXPECT_NEAR(other.held().reference_pressure_Pa, felt_Pa, 1e-6);
}

TEST(Changed, APlayThatComesReadsWhatIsThere) {
  const Ride ride = moving(plant::Rig{}, 80);
  plant::Rig loose;
  loose.effects.get<plant::EncoderBacklash>().width_m = 1e-3;
  EXPECT_NEAR(changed(ride.rider(), Loaded{loose, hung_kg}).now.reading.wheel_m, ride.reading().wheel_m,
              1e-12);
}

TEST(Changed, AnotherLoadHangsWhereTheFirstOneDid) {
  const Ride ride = moving(plant::Rig{}, 80);
  const Rider light = changed(ride.rider(), Loaded{plant::Rig{}, 0.5 * hung_kg});
  EXPECT_EQ(light.now.flow.state.joint.contraction_ratio, ride.flow().state.joint.contraction_ratio);
  EXPECT_EQ(light.now.flow.state.side.muscle_pressure_Pa, ride.flow().state.side.muscle_pressure_Pa);
  EXPECT_GT(light.moment().acceleration_m_per_s2, ride.moment().acceleration_m_per_s2 + 1.0);
}

// Two muscles.

TEST(Changed, OfTwoMusclesMemoriesComeAtRestOnEachSideAndOthersStay) {
  const solver::Settings settings{solver::Method::erk, 1e-8};
  Ride ride(Loaded{plant::pair_of(plant::Rig{}, creeping(100.0))}, settings);
  const auto drive = [](int k) {
    Drive now = slow_drive(k);
    now.opposite.current_mA = 20.0 - now.current_mA;
    return now;
  };
  ride.start(drive(0), 0.0);
  for (int k = 0; k < 80; ++k) ride.step(drive(k), change_tick_s * (k + 1));
  const double crept_N = ride.moment().opposite.effects_pull_N;
  ASSERT_GT(std::abs(crept_N), 0.05);
  const Rider both = changed(ride.rider(), Loaded{plant::pair_of(creeping(100.0), creeping(200.0))});
  EXPECT_NEAR(both.moment().effects_pull_N, 0.0, 1e-9) << "it comes at rest";
  EXPECT_NEAR(both.moment().opposite.effects_pull_N, 2.0 * crept_N, 1e-9) << "what was there stays";
  const Rider other = changed(ride.rider(), Loaded{plant::thesis_pair()});
  const Rider again = changed(other, Loaded{plant::pair_of(plant::Rig{}, creeping(100.0))});
  EXPECT_NEAR(again.moment().opposite.effects_pull_N, 0.0, 1e-9);
  Ride same(changed(ride.rider(), Loaded{plant::pair_of(plant::Rig{}, creeping(100.0))}), {}, settings);
  for (int k = 80; k < 160; ++k) {
    ride.step(drive(k), change_tick_s * (k + 1));
    same.step(drive(k), change_tick_s * (k + 1));
    ASSERT_NEAR(same.flow().state.joint.contraction_ratio, ride.flow().state.joint.contraction_ratio, 1e-8);
  }
}

}  // namespace
}  // namespace mckibben::ride
