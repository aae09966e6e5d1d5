// Random rigs under random currents: whatever the values, a run stays within what is physically possible, and
// what went in and what came out add up.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <controllers/waveform.hpp>
#include <plant/plant.hpp>
#include <sim/run/simulate.hpp>

#include "random_rides.hpp"

namespace mckibben::run {
namespace {

using plant::Chance;
using plant::random_current;

plant::Rig tuned_rig(Chance& chance) {
  plant::Rig rig;
  rig.muscle.rest_length_m = chance.around(0.3, 2.0);
  rig.muscle.rest_radius_m = chance.around(7.5e-3, 1.7);
  rig.muscle.braid_angle_rad = chance.between(15.0, 28.0) * plant::degree_rad;
  rig.muscle.end_correction = chance.between(1.0, 1.6);
  rig.muscle.dead_volume_m3 = chance.around(5e-6, 3.0);
  rig.muscle.contact_surface =
      chance.pick(2) ? plant::ContactSurface::squared : plant::ContactSurface::printed;
  rig.friction.law = static_cast<plant::FrictionLaw>(chance.pick(4));
  rig.friction.memory = chance.pick(4) ? plant::FrictionMemory::lugre : plant::FrictionMemory::coulomb;
  rig.friction.scale = chance.between(0.2, 2.0);
  rig.friction.bristle_stiffness_N_per_m = chance.around(4e5, 5.0);
  rig.valve.supply_pressure_Pa = chance.between(5.5e5, 9e5);
  rig.valve.conductance_m3_per_s_Pa = chance.around(4e-9, 3.0);
  rig.valve.proportional_band_Pa = chance.around(0.3e5, 3.0);
  rig.valve.volume_m3 = chance.around(5e-5, 3.0);
  rig.hose.conductance_m3_per_s_Pa = chance.around(1.5e-8, 3.0);
  rig.joint.guide_damping_N_s_per_m = chance.between(0.0, 60.0);
  rig.friction.f1_s2_per_mA2 = chance.between(0.0, 2e-3);
  rig.friction.bristle_damping_N_s_per_m = chance.around(400.0, 2.0);
  rig.friction.floor_N = chance.around(1.0, 3.0);
  rig.muscle.stop_stiffness_N_per_m = chance.around(3e5, 3.0);
  rig.muscle.stop_damping_s_per_m = chance.between(0.0, 40.0);
  rig.gas.temperature_K = chance.between(270.0, 330.0);
  rig.gas.atmosphere_Pa = chance.between(7e4, 1.1e5);
  rig.joint.wheel_radius_m = chance.around(0.03, 2.0);
  rig.dac.bits = 8 + chance.pick(9);
  rig.sensors.position().pulses_per_turn = 100 + chance.pick(2000);
  rig.tick_s = chance.around(0.012, 2.0);
  rig.sensors.position().wiring =
      chance.pick(2) ? plant::EncoderWiring::ideal : plant::EncoderWiring::crosswise;
  return rig;
}

class AnyRig : public testing::TestWithParam<unsigned> {};

TEST_P(AnyRig, StaysWithinWhatIsPossible) {
  Chance chance(GetParam());
  RunPlan plan;
  plan.rig = tuned_rig(chance);
  plan.load_kg = chance.between(0.5, 40.0);
  plan.ticks = 600;
  plan.keep_ledger = true;
  controllers::RecordedCurrent current;
  current.samples_mA = random_current(chance, plan.ticks);
  plant::draw_cord(chance, plan.rig.muscle, plan.rig.friction.memory);
  const auto controller = current.make(knowledge_of(plan.rig, {}));
  const auto recording = simulate(plan, *controller);
  ASSERT_EQ(recording.failure, "");

  const plant::Plant plant(plan.rig, plan.load_kg);
  const double per_count = contraction_per_count(plan.rig);
  double lowest = 0.0, highest = 0.0;
  for (const auto& sample : recording.samples) {
    const auto& joint = sample.state.joint;
    const auto& side = sample.state.side;
    ASSERT_TRUE(plant.in_domain(sample.state, sample.cords())) << "t = " << sample.time_s;
    ASSERT_TRUE(std::isfinite(sample.braid_force_N) && std::isfinite(sample.friction_force_N));
    EXPECT_GE(side.valve_pressure_Pa, -1.0);  // never below the atmosphere, never above the supply
    EXPECT_LE(side.valve_pressure_Pa, plan.rig.valve.supply_pressure_Pa + 1.0);
    EXPECT_GE(side.muscle_pressure_Pa, -1.0);
    EXPECT_LE(side.muscle_pressure_Pa, plan.rig.valve.supply_pressure_Pa + 1.0);
    lowest = std::min(lowest, joint.contraction_ratio);
    highest = std::max(highest, sample.contraction_ratio);  // of the muscle itself
    if (plan.rig.sensors.position().wiring == plant::EncoderWiring::ideal) {
      EXPECT_EQ(sample.counts, std::floor(joint.contraction_ratio / per_count));
    }
    EXPECT_LE(std::abs(static_cast<double>(sample.counts)), 1.0 / per_count);
  }
  EXPECT_EQ(recording.largest_contraction_ratio, highest);
  EXPECT_LT(highest, 1.0 / plan.rig.muscle.end_correction);
  EXPECT_LT(recording.imbalance.energy, 1e-5);
  EXPECT_GE(recording.ledger.air_drawn_kg, 0.0);
  EXPECT_GE(recording.ledger.air_vented_kg, 0.0);
  EXPECT_GE(recording.ledger.guide_work_J, 0.0);
}

constexpr auto methods = {solver::Method::automatic, solver::Method::erk, solver::Method::cvode};

// The first two seeds: Coulomb friction that, with CVODE, once pushed the load over the top.
TEST(ModerateRigs, CloseTheirBooksWithEveryMethodAndAgree) {
  for (const unsigned seed : {100228u, 100161u, 100004u, 100059u, 100065u, 100069u}) {
    SCOPED_TRACE(seed);
    const Recording first = random_ride(seed, false, solver::Method::erk);
    const auto& end = first.samples.back().state;
    for (const auto method : methods) {
      SCOPED_TRACE(static_cast<int>(method));
      const Recording run = random_ride(seed, false, method);
      ASSERT_EQ(run.failure, "");
      EXPECT_LT(run.imbalance.gas, 1e-6);
      EXPECT_LT(run.imbalance.energy, 1e-6);
      EXPECT_TRUE(doubts(run).empty());
      EXPECT_NEAR(run.ledger.thread_friction_work_J, first.ledger.thread_friction_work_J, 2e-5);
      EXPECT_NEAR(run.samples.back().state.joint.contraction_ratio, end.joint.contraction_ratio, 1e-5);
    }
  }
}

// By day: Doubts.TellOfBooksThatDoNotClose, WholeRange.RunsOrSaysWhatToDo.
TEST(NightlyModerateRigs, SayWhereTheirBooksDoNotClose) {
  // Which one it is depends on how many effects there are to draw.
  const auto is_open = [](unsigned seed) {
    return random_ride(seed, false, solver::Method::automatic).imbalance.energy > 1e-6;
  };
  unsigned seed = 50;
  while (seed < 2000 && !is_open(seed)) ++seed;
  const Recording run = random_ride(seed, false, solver::Method::automatic);
  ASSERT_GT(run.imbalance.energy, 1e-6);
  ASSERT_EQ(doubts(run).size(), 1u);
  EXPECT_NE(doubts(run)[0].find("a tighter integrator.tolerance helps"), std::string::npos);
  RandomRide tighter(seed, false);
  tighter.plan.rig.integrator.tolerance *= 0.1;
  const auto controller = tighter.current.make(knowledge_of(tighter.plan.rig, {}));
  EXPECT_TRUE(doubts(simulate(tighter.plan, *controller)).empty());
}

TEST(WholeRange, RunsOrSaysWhatToDoAndClosesItsBooksOrSaysSo) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const Recording run = random_ride(seed, true, solver::Method::automatic);
    EXPECT_EQ(run.failure, "");
    EXPECT_TRUE((run.imbalance.gas <= 1e-6 && run.imbalance.energy <= 1e-6) || !doubts(run).empty());
  }
}

TEST(Doubts, TellOfBooksThatDoNotCloseAndOfSuction) {
  Recording run;
  Sample sample{};
  sample.state = {{0.1, 0.0}, {1e5, 1e5, 0.0}, {}};
  run.samples.push_back(sample);
  run.imbalance = {9e-7, 9e-7};
  EXPECT_TRUE(doubts(run).empty());
  run.imbalance.energy = 0.012;
  sample.time_s = 0.5;
  sample.state.side.muscle_pressure_Pa = -0.79e5;
  run.samples.push_back(sample);
  const auto said = doubts(run);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_NE(said[0].find("0.012 of the work"), std::string::npos) << said[0];
  EXPECT_NE(said[1].find("0.79 bar below the atmosphere at 0.500 s"), std::string::npos) << said[1];
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyRig, testing::Range(1u, 61u));

}  // namespace
}  // namespace mckibben::run
