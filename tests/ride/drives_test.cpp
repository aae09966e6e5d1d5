// Two muscles on one wheel, muscles at given pressure and at given length: nothing is lost, what is saved
// goes on to the same bits, both kinds of friction, the effects.
#include <array>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <sim/ride/ride.hpp>

#include "switched_on.hpp"

namespace mckibben::ride {
namespace {

using solver::Method;

plant::Rig rubbing(plant::Rig rig, plant::FrictionMemory memory) {
  rig.friction.memory = memory;
  return rig;
}

/// One muscle fills while the other vents, and back.
Drive turning(double at_s) {
  Drive drive;
  drive.current_mA = 11.0 + 4.0 * std::sin(2.0 * at_s);
  drive.opposite.current_mA = 11.0 - 4.0 * std::sin(2.0 * at_s);
  return drive;
}

/// As a test bench would: from one length and pressure to others, with rests between.
Drive pulling(double at_s) {
  Drive drive;
  drive.muscle_pressure_Pa = 3e5 + 1e5 * std::sin(at_s);
  drive.contraction_ratio = 0.1 + 0.05 * std::sin(std::floor(2.0 * at_s));
  return drive;
}

/// The pressure behind the valve is given, and a hand pulls on the load besides.
Drive blowing(double at_s) {
  Drive drive;
  drive.valve_pressure_Pa = 3e5 + 1e5 * std::sin(at_s);
  drive.joint_force_N = 20.0 * std::sin(3.0 * at_s);
  return drive;
}

/// A pair that is blown up so, its joint turned from outside.
Drive blowing_a_pair(double at_s) {
  Drive drive = blowing(at_s);
  drive.opposite.valve_pressure_Pa = 3e5 - 1e5 * std::sin(at_s);
  return drive;
}

struct Journey {
  Drive (*drive)(double);
  bool pair;
};
constexpr std::array journeys{Journey{turning, true}, Journey{pulling, false}, Journey{blowing, false},
                              Journey{blowing_a_pair, true}};

Ride ride_of(const Journey& journey, const plant::Rig& rig, Method method) {
  const solver::Settings settings{method, 1e-7};
  Ride ride = journey.pair ? Ride(Loaded{plant::pair_of(rig, rig)}, settings, true)
                           : Ride(Loaded{rig, 5.0}, settings, true);
  ride.start(journey.drive(0.0), 0.0);
  return ride;
}

TEST(Drives, LoseNoGasAndNoEnergyWithOneMuscleOrTwo) {
  for (const Journey& journey : journeys)
    for (const auto method : {Method::erk, Method::cvode})
      for (const auto memory : {plant::FrictionMemory::lugre, plant::FrictionMemory::coulomb})
        for (const plant::Rig& rig : {plant::Rig{}, plant::rig_with_all_effects()}) {
          // Without a bristle nothing is left that would steer CVODE's steps: see docs/architecture.md.
          if (journey.drive == pulling && memory == plant::FrictionMemory::coulomb && method == Method::cvode)
            continue;
          Ride ride = ride_of(journey, rubbing(rig, memory), method);
          const auto first = ride.flow().state;
          for (int k = 1; k <= 300; ++k) ride.step(journey.drive(0.01 * k), 0.01 * k);
          const auto lost = ride.plant().imbalance(first, ride.flow().state, ride.flow().ledger);
          EXPECT_LT(lost.gas, 1e-6) << journey.pair << static_cast<int>(memory);
          EXPECT_LT(lost.energy, 1e-6) << journey.pair << static_cast<int>(memory);
          EXPECT_GT(std::abs(ride.flow().ledger.braid_work_J), 1.0);
        }
}

TEST(Drives, GoOnToTheSameBitsFromWhatWasSaved) {
  for (const Journey& journey : journeys) {
    Ride ride = ride_of(journey, plant::rig_with_all_effects(), Method::automatic);
    for (int k = 1; k <= 50; ++k) ride.step(journey.drive(0.01 * k), 0.01 * k);
    Ride copy = ride;
    for (int k = 51; k <= 100; ++k) {
      ride.step(journey.drive(0.01 * k), 0.01 * k);
      copy.step(journey.drive(0.01 * k), 0.01 * k);
    }
    const auto &a = ride.flow().state, &b = copy.flow().state;
    EXPECT_EQ(a.joint.contraction_ratio, b.joint.contraction_ratio);
    EXPECT_EQ(a.side.muscle_pressure_Pa, b.side.muscle_pressure_Pa);
    EXPECT_EQ(a.opposite.bristle_m, b.opposite.bristle_m);
    EXPECT_EQ(ride.moment().cord_force_N(), copy.moment().cord_force_N());
  }
}

// Equal muscles at equal pressures: whatever rubs, the link hangs where it hung.
TEST(Drives, EqualMusclesHoldTheLinkWhereItHangs) {
  for (const auto memory : {plant::FrictionMemory::lugre, plant::FrictionMemory::coulomb}) {
    const plant::Rig rig = rubbing({}, memory);
    Ride ride(Loaded{plant::pair_of(rig, rig)}, {Method::erk, 1e-7});
    Drive drive;
    drive.current_mA = drive.opposite.current_mA = 12.0;
    ride.start(drive, 0.0);
    for (int k = 1; k <= 100; ++k) ride.step(drive, 0.01 * k);
    EXPECT_NEAR(ride.plant().angle_rad(ride.flow().state.joint.contraction_ratio), 0.0, 1e-9);
    EXPECT_NEAR(ride.moment().cord_force_N(), ride.moment().opposite.cord_force_N(), 1e-6);
    EXPECT_EQ(ride.reading().of(plant::Sensed::muscle_pressure),
              ride.reading().of(plant::Sensed::muscle_pressure, 2));
  }
}

// A force from outside carries what a load of that weight would.
TEST(Drives, AForceOnTheJointIsAWeightWithoutMass) {
  Ride ride(Loaded{{}, 5.0}, {Method::erk, 1e-7});
  Drive drive;
  drive.valve_pressure_Pa = 3e5;
  drive.joint_force_N = 50.0;
  ride.start(drive, 0.0);
  for (int k = 1; k <= 400; ++k) ride.step(drive, 0.01 * k);
  EXPECT_NEAR(ride.moment().cord_force_N(), 5.0 * 9.80665 + 50.0, 1e-4);
  EXPECT_NEAR(ride.flow().state.side.muscle_pressure_Pa, 3e5, 1.0);
  EXPECT_GT(ride.flow().state.joint.contraction_ratio, 0.05);
}

// What a valve made of its commands, given to a rig with another valve, fills the muscle in the same way.
TEST(Drives, AGivenValvePressureTakesTheValvesPlace) {
  constexpr double step_s = 0.0005;
  Ride ride(Loaded{{}, 10.0}, {Method::erk, 1e-8});
  plant::Rig other;
  other.valve.conductance_m3_per_s_Pa *= 0.1;
  other.effects.get<plant::ValveDeadBand>().half_width_Pa = 2e4;
  Ride given(Loaded{other, 10.0}, {Method::erk, 1e-8});
  const auto command = [](int k) {
    Drive drive;
    drive.current_mA = 12.0 + 4.0 * std::sin(0.0025 * k);
    return drive;
  };
  const auto pressure = [&] {
    Drive drive;
    drive.valve_pressure_Pa = ride.flow().state.side.valve_pressure_Pa;
    return drive;
  };
  ride.start(command(0), 0.0);
  given.start(pressure(), 0.0);
  for (int k = 0; k < 2000; ++k) {
    ride.step(command(k), step_s * (k + 1));
    given.step(pressure(), step_s * (k + 1));
    ASSERT_NEAR(given.flow().state.side.muscle_pressure_Pa, ride.flow().state.side.muscle_pressure_Pa, 10.0);
    ASSERT_NEAR(given.flow().state.joint.contraction_ratio, ride.flow().state.joint.contraction_ratio, 1e-5);
  }
}

// The link's side that is blown up pulls it up, by the balance of the cords and the link's weight.
TEST(Drives, AtRestTheCordsCarryTheLink) {
  plant::Rig pair = plant::thesis_pair();
  pair.pair()->damping_N_m_s_per_rad = 2.0;
  Ride ride(Loaded{pair}, {Method::erk, 1e-7});
  Drive drive;
  drive.current_mA = 14.0;
  drive.opposite.current_mA = 10.0;
  ride.start(drive, 0.0);
  for (int k = 1; k <= 800; ++k) ride.step(drive, 0.01 * k);
  const auto now = ride.moment();
  const double angle = ride.plant().angle_rad(ride.flow().state.joint.contraction_ratio);
  EXPECT_GT(angle, 0.05);
  EXPECT_NEAR(0.03 * (now.cord_force_N() - now.opposite.cord_force_N()),
              2.0 * 9.80665 * 0.25 * std::sin(angle), 1e-3);
  EXPECT_NEAR(ride.reading().wheel_m, 0.03 * angle, 1e-12);
}

// Exact stick and slip at a given length: the threads pull with their whole level against the way the end
// goes, keep that force where it stops, and have none before it has moved.
TEST(Drives, CoulombThreadsKeepTheirForceWhereABenchStops) {
  Ride ride(Loaded{rubbing({}, plant::FrictionMemory::coulomb), 0.0}, {Method::erk, 1e-7});
  Drive drive;
  drive.muscle_pressure_Pa = 3e5;
  drive.contraction_ratio = 0.05;
  ride.start(drive, 0.0);
  EXPECT_EQ(ride.moment().friction_force_N, 0.0);
  drive.contraction_ratio = 0.06;
  ride.step(drive, 0.1);
  EXPECT_EQ(ride.moment().friction_force_N, -ride.moment().friction_level_N);
  ride.step(drive, 0.2);
  EXPECT_EQ(ride.moment().friction_force_N, -ride.moment().friction_level_N);
  drive.contraction_ratio = 0.055;
  ride.step(drive, 0.3);
  EXPECT_EQ(ride.moment().friction_force_N, ride.moment().friction_level_N);
}

// Rubber that creeps has come to rest at the length at which a bench holds it, and pulls back after a move.
TEST(Drives, AMuscleThatIsHeldBeginsAtRestAtItsLength) {
  plant::Rig rig;
  auto& creep = rig.effects.get<plant::BladderCreep>();
  creep.stiffness_N_per_m = 1000.0;
  creep.time_s = 30.0;
  Ride ride(Loaded{rig, 0.0}, {Method::erk, 1e-7}), without(Loaded{{}, 0.0}, {Method::erk, 1e-7});
  Drive drive;
  drive.muscle_pressure_Pa = 3e5;
  drive.contraction_ratio = 0.15;
  const auto pull_N = [&] { return ride.moment().cord_force_N() - without.moment().cord_force_N(); };
  ride.start(drive, 0.0);
  without.start(drive, 0.0);
  EXPECT_NEAR(pull_N(), 0.0, 1e-9);
  drive.contraction_ratio = 0.16;
  ride.step(drive, 0.1);
  without.step(drive, 0.1);
  EXPECT_NEAR(pull_N(), -1000.0 * 0.01 * rig.muscle.rest_length_m, 0.02);
}

TEST(Drives, APairOfDifferentFrictionOrGasIsRefused) {
  plant::Rig rough, warm;
  rough.friction.memory = plant::FrictionMemory::coulomb;
  EXPECT_THROW(Ride(Loaded{plant::pair_of({}, rough)}, {}), std::invalid_argument);
  warm.gas.temperature_K += 1.0;
  EXPECT_THROW(plant::Plant({}, warm, {}), std::invalid_argument);
}

}  // namespace
}  // namespace mckibben::ride
