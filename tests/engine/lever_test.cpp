// Levers with a known answer, for both methods: pendulums of any amplitude, moments that balance, stops that
// hold, and what a run must conserve.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "rig_on_bench.hpp"

namespace mckibben::engine {
namespace {

using plant::degree_rad, plant::Lever;

class OfLever : public testing::TestWithParam<Method> {};

/// A thread in place of a muscle, next to no friction, and on it a lever without damping.
plant::Rig bare(const Lever& lever) {
  plant::Rig rig;
  rig.muscle.rest_radius_m = 5e-4;
  rig.valve.zero_pressure_Pa = 0.0;
  rig.friction.scale = 0.0;
  rig.friction.floor_N = 1e-9;
  rig.friction.bristle_stiffness_N_per_m = 1e-6;  // as weak as the floor, or it is stiff
  rig.friction.bristle_damping_N_s_per_m = 0.0;
  rig.joint.wheel_inertia_kg_m2 = 0.0;
  rig.mechanics = lever;
  rig.mechanics.emplace<Lever>(lever).damping_N_m_s_per_rad = 0.0;
  return rig;
}

Lever hanging(Lever lever) {
  lever.hangs_at_rad = 0.0;
  lever.contraction_ratio = 0.15;
  return lever;
}

/// Three ways to hang the same pendulum: by a wheel, by points, by a table of arms.
std::vector<Lever> pendulums() {
  Lever wheel = hanging({}), points = wheel, table = wheel;
  wheel.arms = {{0.0, 0.01}};
  points.base_m = 0.30;
  points.attached_m = 0.02;
  points.opening_rad = 90.0 * degree_rad;
  table.arms = {{-1.5, 0.008}, {-0.3, 0.012}, {0.4, 0.010}, {1.5, 0.016}};
  return {wheel, points, table};
}

void let_go(RigOnBench& bench, double angle_rad) {
  bench.start(4.0);
  bench.held.given = plant::GivenPressure::muscle;
  bench.flow.state.side.muscle_pressure_Pa = 0.0;
  bench.flow.state.joint.contraction_ratio = bench.plant.ratio_at_rad(angle_rad);
}

double angle_rad(const RigOnBench& bench) {
  return bench.plant.angle_rad(bench.flow.state.joint.contraction_ratio);
}

void run(RigOnBench& bench, double from_s, double to_s) {
  constexpr int parts = 50;
  const double part_s = (to_s - from_s) / parts;
  for (int k = 0; k < parts; ++k)
    bench.integrator->advance(bench.flow, bench.held, from_s + k * part_s, from_s + (k + 1) * part_s);
}

// T = 4 K(sin(A/2)) sqrt(I/(m g L)), a whole turn of the elliptic integral; it is at the bottom after a
// quarter and on the other side after a half.
TEST_P(OfLever, APendulumSwingsAsTheEllipticIntegralSays) {
  for (const Lever& lever : pendulums())
    for (const double amplitude : {1.0 * degree_rad, 60.0 * degree_rad}) {
      SCOPED_TRACE(testing::Message() << lever.arms.size() << " lines, " << amplitude << " rad");
      const double load_kg = 0.5;
      RigOnBench bench(bare(lever), load_kg, {GetParam(), 1e-11}, true);
      let_go(bench, amplitude);
      const auto before = bench.flow.state;
      const double moment_N_m = plant::gravity_m_per_s2 * (1.0 * 0.15 + load_kg * 0.3);
      const double inertia = 0.03 + load_kg * 0.09;
      const double period_s =
          4.0 * std::comp_ellint_1(std::sin(0.5 * amplitude)) * std::sqrt(inertia / moment_N_m);
      run(bench, 0.0, 0.25 * period_s);
      EXPECT_NEAR(angle_rad(bench), 0.0, 1e-6 * amplitude + 1e-9);
      run(bench, 0.25 * period_s, 0.5 * period_s);
      EXPECT_NEAR(angle_rad(bench), -amplitude, 1e-6 * amplitude);
      run(bench, 0.5 * period_s, period_s);
      EXPECT_NEAR(angle_rad(bench), amplitude, 1e-6 * amplitude);
      EXPECT_NEAR(bench.plant.mechanical_energy_J(bench.flow.state), bench.plant.mechanical_energy_J(before),
                  1e-8);
    }
}

// In a horizontal plane nothing hangs: what turns goes on turning, whatever the arm.
TEST_P(OfLever, FreeInertiaGoesOnTurning) {
  for (Lever lever : pendulums()) {
    lever.plane = plant::Plane::horizontal;
    RigOnBench bench(bare(lever), 0.5, {GetParam(), 1e-11});
    let_go(bench, -0.9);
    bench.flow.state.joint.contraction_speed_per_s =
        3.0 * bench.plant.arm_m(bench.flow.state.joint.contraction_ratio) / 0.3;  // 3 rad/s
    run(bench, 0.0, 0.6);
    EXPECT_NEAR(angle_rad(bench), 0.9, 1e-6) << lever.arms.size();
    EXPECT_NEAR(bench.plant.angle_speed_rad_per_s(bench.flow.state.joint), 3.0, 1e-5);
  }
}

// theta = 1/2 torque/I t^2, whatever the arm.
TEST_P(OfLever, ATorqueFromOutsideTurnsIt) {
  for (Lever lever : pendulums()) {
    lever.plane = plant::Plane::horizontal;
    const plant::Rig rig = bare(lever);
    RigOnBench bench(rig, 0.5, {GetParam(), 1e-11}, true);
    let_go(bench, 0.0);
    const auto before = bench.flow.state;
    bench.held.joint_force_N = -0.1 / rig.joint.wheel_radius_m;
    run(bench, 0.0, 1.0);
    EXPECT_NEAR(angle_rad(bench), 0.5 * 0.1 / (0.03 + 0.5 * 0.09), 1e-6);
    EXPECT_NEAR(bench.flow.ledger.bench_work_J, 0.1 * angle_rad(bench), 1e-6);
    EXPECT_LT(bench.plant.imbalance(before, bench.flow.state, bench.flow.ledger).energy, 1e-6);
  }
}

TEST_P(OfLever, ASpringTurnsItBackAndForth) {
  for (Lever lever : pendulums()) {
    lever.plane = plant::Plane::horizontal;
    lever.spring_N_m_per_rad = 2.0;
    RigOnBench bench(bare(lever), 0.5, {GetParam(), 1e-11});
    let_go(bench, 0.8);
    run(bench, 0.0, 1.0);
    EXPECT_NEAR(angle_rad(bench), 0.8 * std::cos(std::sqrt(2.0 / (0.03 + 0.5 * 0.09))), 1e-6);
  }
}

// A forearm against its weight, a load and a spring: the root of r F = M by bisection, its geometry by hand.
TEST_P(OfLever, AForearmStandsWhereItsMomentsBalance) {
  for (const double pressure_Pa : {1.5e5, 2.5e5, 4e5}) {
    Lever lever;
    lever.spring_N_m_per_rad = 1.5;
    lever.spring_preload_N_m = 0.2;
    plant::Rig rig = bare(lever);
    rig.muscle.rest_radius_m = plant::Muscle{}.rest_radius_m;
    rig.lever()->damping_N_m_s_per_rad = 3.0;
    RigOnBench bench(rig, 1.0, {GetParam(), 1e-10});
    let_go(bench, 0.0);
    bench.flow.state.side.muscle_pressure_Pa = pressure_Pa;
    run(bench, 0.0, 6.0);
    run(bench, 6.0, 60.0);
    const plant::Braid braid(rig.muscle);
    const auto c = [](double theta) {
      return std::sqrt(0.09 + 0.0025 - 0.03 * std::cos(150.0 * degree_rad - theta));
    };
    const auto surplus_N_m = [&](double theta) {
      const double arm = 0.015 * std::sin(150.0 * degree_rad - theta) / c(theta);
      return arm * braid.force_N((c(0.0) - c(theta)) / 0.3, pressure_Pa) - 0.2 - 1.5 * theta -
             9.80665 * (0.15 + 0.3) * std::sin(theta + 30.0 * degree_rad);
    };
    double low = 0.0, high = 2.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (surplus_N_m(middle) > 0.0 ? low : high) = middle;
    }
    EXPECT_GT(low, 0.1);
    EXPECT_NEAR(angle_rad(bench), low, 1e-6) << pressure_Pa;
  }
}

// As deep in the stop as what is left of the muscle's pull presses it.
TEST_P(OfLever, AStopHoldsIt) {
  plant::Rig rig = bare(Lever{});
  rig.muscle.rest_radius_m = plant::Muscle{}.rest_radius_m;
  rig.lever()->damping_N_m_s_per_rad = 0.5;
  rig.lever()->contraction_ratio = 0.05;
  rig.joint.highest_rad = 0.5;
  rig.joint.lowest_rad = -0.1;
  RigOnBench bench(rig, 1.0, {GetParam(), 1e-10}, true);
  let_go(bench, 0.2);
  const auto before = bench.flow.state;
  run(bench, 0.0, 3.0);
  const auto lies = bench.plant.moment(bench.flow.state, bench.flow.memory, bench.held);
  const double hangs_N = 9.80665 * 0.45 * std::sin(angle_rad(bench) + 30.0 * degree_rad) /
                         bench.plant.arm_m(bench.flow.state.joint.contraction_ratio);
  EXPECT_NEAR(lies.joint_stop_force_N, hangs_N, 1e-2);  // fell onto it
  EXPECT_NEAR(hangs_N,
              3e5 * (bench.plant.rise_m(bench.plant.ratio_at_rad(-0.1)) -
                     bench.plant.rise_m(bench.flow.state.joint.contraction_ratio)),
              1e-2);
  bench.flow.state = before;
  bench.flow.ledger = bench.plant.opened(before);
  bench.flow.state.side.muscle_pressure_Pa = 4e5;
  const auto pressed = bench.flow.state;
  run(bench, 0.0, 3.0);
  const auto now = bench.plant.moment(bench.flow.state, bench.flow.memory, bench.held);
  const double rise_m = bench.plant.rise_m(bench.flow.state.joint.contraction_ratio);
  const double at_stop_m = bench.plant.rise_m(bench.plant.ratio_at_rad(0.5));
  EXPECT_GT(rise_m, at_stop_m);
  EXPECT_NEAR(now.joint_stop_force_N, -3e5 * (rise_m - at_stop_m), 1e-3);
  const double arm_m = bench.plant.arm_m(bench.flow.state.joint.contraction_ratio);
  const double weight_N = 9.80665 * 0.45 * std::sin(angle_rad(bench) + 30.0 * degree_rad) / arm_m;
  EXPECT_NEAR(now.joint_stop_force_N, weight_N - now.braid_force_N, 1e-3);
  // What the stop holds in its spring is no part of the lever's energy: the ledger has it as work.
  EXPECT_LT(bench.plant.imbalance(pressed, bench.flow.state, bench.flow.ledger).energy, 1e-7);
}

TEST_P(OfLever, AStopBelowALoadBearsIt) {
  plant::Rig rig;
  rig.joint.lowest_ratio = 0.05;
  RigOnBench bench(rig, 10.0, {GetParam(), 1e-9});
  bench.start(4.0);
  EXPECT_DOUBLE_EQ(bench.flow.state.joint.contraction_ratio, 0.05);
  bench.held.given = plant::GivenPressure::muscle;
  bench.flow.state.side.muscle_pressure_Pa = 0.0;
  bench.hold(4.0, 200);
  EXPECT_NEAR(0.3 * bench.flow.state.joint.contraction_ratio, 0.015 - 10.0 * 9.80665 / 3e5, 2e-6);
}

TEST_P(OfLever, AStopOfAPairIsAnAngle) {
  plant::Rig rig = plant::thesis_pair();
  rig.joint.highest_rad = 10.0 * degree_rad;
  RigOnBench bench(rig, 0.0, {GetParam(), 1e-9});
  bench.start(12.0);
  bench.held.opposite.reference_pressure_Pa = 0.5e5;
  bench.hold(20.0, 300);
  const double angle = bench.plant.angle_rad(bench.flow.state.joint.contraction_ratio);
  const auto now = bench.plant.moment(bench.flow.state, bench.flow.memory, bench.held);
  EXPECT_GT(angle, 10.0 * degree_rad);
  EXPECT_LT(angle, 15.0 * degree_rad);
  EXPECT_NEAR(now.joint_stop_force_N, -3e5 * 0.03 * (angle - 10.0 * degree_rad), 1.0);
}

TEST_P(OfLever, WhatComesAndGoesIsInTheLedger) {
  Lever lever;
  lever.spring_N_m_per_rad = 1.0;
  lever.spring_ways = plant::SpringWays::one;
  lever.spring_preload_N_m = -0.5;
  plant::Rig rig;
  rig.mechanics = lever;
  rig.joint.moving_mass_kg = 0.2;
  rig.joint.highest_rad = 1.5;
  RigOnBench bench(rig, 1.5, {GetParam(), 1e-10}, true);
  bench.start(4.0);
  const auto before = bench.flow.state;
  for (int k = 0; k < 200; ++k) bench.hold(12.0 - 8.0 * std::cos(0.06 * k));
  EXPECT_GT(angle_rad(bench), 0.3);
  const plant::Imbalance lost = bench.plant.imbalance(before, bench.flow.state, bench.flow.ledger);
  EXPECT_LT(lost.energy, 1e-7);
  EXPECT_LT(lost.gas, 1e-8);
}

// J on a wheel of radius R is J/R^2 on its cord.
TEST_P(OfLever, AWheelIsALeverOfOneArm) {
  plant::Rig wheel, lever;
  wheel.joint.wheel_inertia_kg_m2 = 0.0;
  wheel.joint.moving_mass_kg = 0.02 / (0.03 * 0.03);
  wheel.joint.guide_damping_N_s_per_m = 20.0;
  wheel.joint.spring_N_per_m = 4000.0;
  lever.joint.wheel_inertia_kg_m2 = 0.0;
  Lever turned;
  turned.arms = {{0.0, 0.03}};
  turned.mass_kg = 0.0;
  turned.inertia_kg_m2 = 0.02;
  turned.damping_N_m_s_per_rad = 20.0 * 0.03 * 0.03;
  turned.spring_N_m_per_rad = 4000.0 * 0.03 * 0.03;
  lever.mechanics = turned;
  RigOnBench one(wheel, 0.0, {GetParam(), 1e-9}), other(lever, 0.0, {GetParam(), 1e-9});
  one.start(4.0);
  other.start(4.0);
  for (int k = 0; k < 100; ++k)
    for (RigOnBench* bench : {&one, &other}) bench->hold(12.0 - 8.0 * std::cos(0.06 * k));
  EXPECT_GT(one.flow.state.joint.contraction_ratio, 0.05);
  EXPECT_NEAR(one.flow.state.joint.contraction_ratio, other.flow.state.joint.contraction_ratio, 1e-9);
  EXPECT_NEAR(angle_rad(other), 10.0 * one.flow.state.joint.contraction_ratio, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(BothMethods, OfLever, testing::Values(Method::erk, Method::cvode),
                         [](const auto& p) { return p.param == Method::erk ? "erk" : "cvode"; });

}  // namespace
}  // namespace mckibben::engine
