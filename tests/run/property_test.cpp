// Random rigs under random currents: whatever the values, a run stays within what is physically possible.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <controllers/waveform.hpp>
#include <plant/plant.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  double around(double value, double factor) {
    return value * std::exp(between(-std::log(factor), std::log(factor)));
  }
  int pick(int count) { return std::uniform_int_distribution(0, count - 1)(random_); }

 private:
  std::mt19937 random_;
};

plant::Rig random_rig(Chance& chance) {
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
  rig.encoder.pulses_per_turn = 100 + chance.pick(2000);
  rig.tick_s = chance.around(0.012, 2.0);
  rig.encoder.wiring = chance.pick(2) ? plant::EncoderWiring::ideal : plant::EncoderWiring::crosswise;
  return rig;
}

/// Jumps, ramps and rests in any order.
std::vector<double> random_current(Chance& chance, std::size_t ticks) {
  std::vector<double> current_mA;
  double now_mA = chance.between(0.0, 20.0);
  while (current_mA.size() < ticks) {
    const double to_mA = chance.between(0.0, 20.0);
    const int lasting = 1 + chance.pick(80);
    const bool jump = chance.pick(3) == 0;
    for (int i = 1; i <= lasting && current_mA.size() < ticks; ++i)
      current_mA.push_back(jump ? to_mA : now_mA + (to_mA - now_mA) * i / lasting);
    now_mA = to_mA;
  }
  return current_mA;
}

class AnyRig : public testing::TestWithParam<unsigned> {};

TEST_P(AnyRig, StaysWithinWhatIsPossible) {
  Chance chance(GetParam());
  RunPlan plan;
  plan.rig = random_rig(chance);
  plan.load_kg = chance.between(0.5, 40.0);
  plan.ticks = 600;
  plan.keep_ledger = true;
  const plant::Plant plant(plan.rig, plan.load_kg);
  controllers::RecordedCurrent current;
  current.samples_mA = random_current(chance, plan.ticks);
  const auto controller = current.make(knowledge_of(plan.rig, {}));
  const auto recording = simulate(plan, *controller);
  ASSERT_EQ(recording.failure, "");

  const double per_count = contraction_per_count(plan.rig);
  double lowest = 0.0, highest = 0.0;
  for (const auto& sample : recording.samples) {
    const auto& [joint, side] = sample.state;
    ASSERT_TRUE(plant.in_domain(sample.state)) << "t = " << sample.time_s;
    ASSERT_TRUE(std::isfinite(sample.braid_force_N) && std::isfinite(sample.friction_force_N));
    EXPECT_GE(side.valve_pressure_Pa, -1.0);  // never below the atmosphere, never above the supply
    EXPECT_LE(side.valve_pressure_Pa, plan.rig.valve.supply_pressure_Pa + 1.0);
    EXPECT_GE(side.muscle_pressure_Pa, -1.0);
    EXPECT_LE(side.muscle_pressure_Pa, plan.rig.valve.supply_pressure_Pa + 1.0);
    lowest = std::min(lowest, joint.contraction_ratio);
    highest = std::max(highest, joint.contraction_ratio);
    if (plan.rig.encoder.wiring == plant::EncoderWiring::ideal) {
      EXPECT_EQ(sample.counts, std::floor(joint.contraction_ratio / per_count));
    }
    EXPECT_LE(std::abs(static_cast<double>(sample.counts)), 1.0 / per_count);
  }
  EXPECT_EQ(recording.largest_contraction_ratio, highest);
  EXPECT_LT(highest, 1.0 / plan.rig.muscle.end_correction);
  EXPECT_GE(recording.ledger.air_drawn_kg, 0.0);
  EXPECT_GE(recording.ledger.air_vented_kg, 0.0);
  EXPECT_GE(recording.ledger.guide_work_J, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyRig, testing::Range(1u, 61u));

}  // namespace
}  // namespace mckibben::run
