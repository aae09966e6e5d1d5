// Cords that stretch, with a known answer, for both methods.
#include <cmath>

#include <gtest/gtest.h>

#include <plant/joint_stiffness.hpp>

#include "rig_on_bench.hpp"

namespace mckibben::engine {
namespace {

using plant::cord_end_speed, plant::cord_stretch;

class OfCord : public testing::TestWithParam<Method> {};

plant::Rig on_cord(double N_per_m, double N_s_per_m = 100.0) {
  plant::Rig rig;
  rig.muscle.cord = {N_per_m, N_s_per_m, 0.1};
  return rig;
}

/// Threads that are one linear spring: they never come near their level.
void as_spring(double N_per_m, plant::Friction& friction) {
  friction.scale = 0.0;
  friction.floor_N = 1e9;
  friction.bristle_stiffness_N_per_m = N_per_m;
  friction.bristle_damping_N_s_per_m = 0.0;
}

void without_friction(plant::Friction& friction) {
  friction.scale = 0.0;
  friction.floor_N = 1e-9;
  friction.bristle_stiffness_N_per_m = 1e-6;
  friction.bristle_damping_N_s_per_m = 0.0;
}

double stretch_m(const RigOnBench& bench) {
  return bench.flow.memory.side[cord_stretch];
}

double joint_m(const RigOnBench& bench) {
  return 0.3 * bench.flow.state.joint.contraction_ratio;
}

// s = m g/k; the muscle stands where its braid carries the weight, and the load as much lower.
TEST_P(OfCord, AtRestItIsStretchedByTheWeight) {
  for (const double N_per_m : {1e4, 1e5, 1e6}) {
    plant::Rig rig = on_cord(N_per_m, 300.0);
    without_friction(rig.friction);
    rig.joint.guide_damping_N_s_per_m = 300.0;
    RigOnBench bench(rig, 10.0, {GetParam(), 1e-9});
    bench.start(4.0);
    bench.held.given = plant::GivenPressure::muscle;
    bench.flow.state.side.muscle_pressure_Pa = 2e5;
    bench.hold(4.0, 400);
    const double weight_N = 10.0 * plant::gravity_m_per_s2;
    EXPECT_NEAR(stretch_m(bench), weight_N / N_per_m, 1e-9) << N_per_m;
    const plant::Braid braid(rig.muscle);
    double low = 0.0, high = braid.largest_contraction_ratio();
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (braid.force_N(middle, 2e5) > weight_N ? low : high) = middle;
    }
    EXPECT_NEAR(joint_m(bench), 0.3 * low - weight_N / N_per_m, 1e-7) << N_per_m;
  }
}

// Two masses, the muscle's end on the threads' spring K, the load on the cord k: the slower of their modes,
// w^2 the smaller root of m1 m2 w^4 - (m1 k + m2 (K + k)) w^2 + K k = 0, which is near (K k/(K + k))/m2.
TEST_P(OfCord, ALoadSwingsOnCordAndThreads) {
  const double K = 4e4, k = 2e4, m1 = 0.1, m2 = 5.0, a_m = 5e-4;
  plant::Rig rig = on_cord(k, 0.0);
  as_spring(K, rig.friction);
  rig.valve.zero_pressure_Pa = 0.0;
  rig.joint.wheel_inertia_kg_m2 = 0.0;
  rig.joint.guide_damping_N_s_per_m = 0.0;
  RigOnBench bench(rig, m2, {GetParam(), 1e-11}, true);
  bench.start(4.0);
  bench.held.given = plant::GivenPressure::muscle;  // none: a muscle without a pull
  const double weight_N = m2 * plant::gravity_m_per_s2;
  const double half = (m1 * k + m2 * (K + k)) / (2.0 * m1 * m2);
  const double square = half - std::sqrt(half * half - K * k / (m1 * m2)), per_s = std::sqrt(square);
  EXPECT_NEAR(per_s, std::sqrt(K * k / (K + k) / m2), 0.01 * per_s);
  const double end_m = a_m * k / (K + k - m1 * square);  // of the muscle's end, in that mode
  auto& side = bench.flow.memory.side;
  bench.flow.state.joint.contraction_ratio = (0.03 + a_m) / 0.3;
  bench.flow.state.side.bristle_m = -weight_N / K + end_m;
  side[cord_stretch] = weight_N / k + end_m - a_m;
  const auto before = bench.flow;
  const double t_s = 0.6;
  bench.hold(4.0, 50);
  EXPECT_NEAR(joint_m(bench), 0.03 + a_m * std::cos(per_s * t_s), 1e-6);
  EXPECT_NEAR(
      bench.plant.moment(bench.flow.state, bench.flow.memory, bench.held).stroke.contraction_ratio * 0.3,
      0.03 + weight_N / k + end_m * std::cos(per_s * t_s), 1e-6);
  // What the threads' spring holds is the ledger's.
  const auto imbalance = bench.plant.imbalance(before.state, bench.flow.state, bench.flow.ledger,
                                               before.memory, bench.flow.memory);
  EXPECT_LT(imbalance.energy, 1e-7);
}

// What a stiff cord makes is its stretch, T/k, and with friction twice what bristles bend, G/sigma0: where
// one of the two has just turned round.
TEST_P(OfCord, AStiffOneIsAsGoodAsNone) {
  for (const double N_per_m : {1e5, 1e6, 1e7}) {
    plant::Rig one = on_cord(N_per_m, 1000.0), other;
    const bool rubs = N_per_m == 1e7;
    one.muscle.cord.end_mass_kg = 0.01;
    for (plant::Rig* rig : {&one, &other}) {
      rig->joint.guide_damping_N_s_per_m = 300.0;
      if (!rubs) without_friction(rig->friction);
    }
    RigOnBench stiff(one, 5.0, {GetParam(), 1e-8}), rigid(other, 5.0, {GetParam(), 1e-8});
    stiff.start(4.0);
    rigid.start(4.0);
    double bent_m = 0.0;
    double largest_m = 0.0;
    for (int tick = 0; tick < 250; ++tick) {
      const double current_mA = 11.0 - 5.0 * std::cos(0.03 * tick);
      for (RigOnBench* bench : {&stiff, &rigid}) bench->hold(current_mA);
      const auto now = rigid.plant.moment(rigid.flow.state, rigid.flow.memory, rigid.held);
      if (rubs) bent_m = std::max(bent_m, now.friction_level_N / other.friction.bristle_stiffness_N_per_m);
      if (tick > 50) largest_m = std::max(largest_m, std::abs(joint_m(stiff) - joint_m(rigid)));
    }
    EXPECT_GT(joint_m(rigid), 0.03);
    const double stretched_m = 5.0 * plant::gravity_m_per_s2 / N_per_m;
    EXPECT_LT(largest_m, 1.2 * stretched_m + 2.0 * bent_m) << N_per_m;
    EXPECT_GT(largest_m, 0.8 * stretched_m) << N_per_m;
  }
}

// Nothing holds a load whose cord is slack; taut, the cord catches it.
TEST_P(OfCord, ASlackOneCarriesNothing) {
  plant::Rig rig = on_cord(2e4, 200.0);
  rig.valve.zero_pressure_Pa = 0.0;
  rig.joint.guide_damping_N_s_per_m = 0.0;
  RigOnBench bench(rig, 5.0, {GetParam(), 1e-9});
  bench.start(4.0);
  bench.held.given = plant::GivenPressure::muscle;
  bench.flow.state.joint.contraction_ratio = 0.2;
  bench.flow.memory.side[cord_stretch] = -0.02;
  bench.hold(4.0, 5);
  const double fallen_m = 0.5 * plant::gravity_m_per_s2 * 0.06 * 0.06 * 5.0 / rig.moved_kg(5.0);
  EXPECT_NEAR(joint_m(bench), 0.06 - fallen_m, 1e-7);
  EXPECT_NEAR(stretch_m(bench), -0.02 + fallen_m, 1e-7);
  EXPECT_EQ(bench.plant.moment(bench.flow.state, bench.flow.memory, bench.held).cord_force_N(), 0.0);
  bench.hold(4.0, 200);
  EXPECT_GT(stretch_m(bench), 0.0);
}

// A cell at a held length reads what braid and cord agree on, where the muscle has shortened into the cord.
TEST_P(OfCord, ItGivesWayToAHeldMuscle) {
  plant::Rig rig = on_cord(3e4);
  without_friction(rig.friction);
  RigOnBench bench(rig, 0.0, {GetParam(), 1e-9});
  bench.start(4.0);
  bench.held.length_is_given = true;
  bench.held.given = plant::GivenPressure::muscle;
  bench.flow.state.joint.contraction_ratio = 0.05;
  bench.flow.state.side.muscle_pressure_Pa = 3e5;
  bench.hold(4.0, 200);
  const plant::Braid braid(rig.muscle);
  double low = 0.0, high = 0.1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (braid.force_N(0.05 + middle / 0.3, 3e5) > 3e4 * middle ? low : high) = middle;
  }
  EXPECT_GT(low, 0.005);
  EXPECT_NEAR(stretch_m(bench), low, 1e-8);
  EXPECT_NEAR(bench.plant.moment(bench.flow.state, bench.flow.memory, bench.held).cord_force_N(), 3e4 * low,
              1e-3);
}

// Gas and work, with all that acts on muscle and load, of a hanging load, a lever and a pair.
TEST_P(OfCord, WhatComesAndGoesIsInTheLedger) {
  plant::Rig hanging = on_cord(2e4);
  hanging.effects.get<plant::ViscousDamping>().damping_N_s_per_m = 50.0;
  plant::Rig lever = hanging;
  hanging.effects.get<plant::GuideFriction>().coefficient = 0.05;
  lever.mechanics = plant::Lever{};
  lever.joint.highest_rad = 1.5;
  const plant::Rig pair = plant::pair_of(on_cord(2e4), on_cord(5e4));
  for (const plant::Rig& rig : {hanging, lever, pair}) {
    SCOPED_TRACE(rig.mechanics.index());
    RigOnBench bench(rig, rig.pair() != nullptr ? 0.0 : 1.5, {GetParam(), 1e-10}, true);
    bench.start(6.0);
    bench.held.opposite.reference_pressure_Pa = 2e5;
    const auto before = bench.flow;
    for (int k = 0; k < 150; ++k) bench.hold(11.0 - 5.0 * std::cos(0.06 * k));
    EXPECT_GT(stretch_m(bench), 1e-4);
    EXPECT_GT(bench.flow.ledger.guide_work_J, 0.0);
    const plant::Imbalance lost = bench.plant.imbalance(before.state, bench.flow.state, bench.flow.ledger,
                                                        before.memory, bench.flow.memory);
    EXPECT_LT(lost.energy, 1e-7);
    EXPECT_LT(lost.gas, 1e-8);
  }
}

// At rest a pair's muscles balance through their cords, and the stiffnesses are those of springs in a row.
TEST_P(OfCord, APairIsSofterByItsCords) {
  const plant::Rig one = on_cord(3e4, 300.0);
  RigOnBench soft(plant::pair_of(one, one), 0.0, {GetParam(), 1e-9});
  soft.start(12.0);
  soft.held.opposite = soft.held;
  soft.hold(12.0, 400);
  const auto now = soft.plant.moment(soft.flow.state, soft.flow.memory, soft.held);
  const double turned = soft.flow.state.joint.contraction_ratio - 0.10;
  EXPECT_NEAR(now.stroke.contraction_ratio, 0.10 + turned + now.cord_force_N() / 3e4 / 0.3, 1e-6);
  EXPECT_NEAR(now.opposite.stroke.contraction_ratio, 0.10 - turned + now.opposite.cord_force_N() / 3e4 / 0.3,
              1e-6);
  EXPECT_NEAR(now.cord_force_N(), now.muscle_force_N(), 1e-3);
  const plant::Braid braid(one.muscle);
  const auto in_a_row = [&](const plant::SideMoment<double>& side, double pressure_Pa) {
    const double e = side.stroke.contraction_ratio;
    const double muscle =
        -(braid.force_N(e + 1e-6, pressure_Pa) - braid.force_N(e - 1e-6, pressure_Pa)) / 2e-6 / 0.3;
    return muscle * 3e4 / (muscle + 3e4);
  };
  const double both = in_a_row(now, soft.flow.state.side.muscle_pressure_Pa) +
                      in_a_row(now.opposite, soft.flow.state.opposite.muscle_pressure_Pa);
  EXPECT_NEAR(joint_stiffness_N_m_per_rad(soft.plant, soft.flow.state, soft.flow.memory, soft.held),
              both * 0.03 * 0.03, 1e-5 * both * 0.03 * 0.03);
}

INSTANTIATE_TEST_SUITE_P(BothMethods, OfCord, testing::Values(Method::erk, Method::cvode),
                         [](const auto& p) { return p.param == Method::erk ? "erk" : "cvode"; });

}  // namespace
}  // namespace mckibben::engine
