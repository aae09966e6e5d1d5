// What any method must do: converge, agree with the other,
// see every jump, fail loudly, leave the ledger aside.
#include <cmath>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include <sim/engine/failure.hpp>

#include "rig_on_bench.hpp"
#include "says.hpp"

namespace mckibben::engine {
namespace {

double current_mA(int k) {
  return 12.0 + 7.0 * std::sin(0.02 * k) + 2.0 * std::sin(0.11 * k);
}

plant::State<double> end_of_ride(Method method, double tolerance, const plant::Rig& rig = {}) {
  RigOnBench bench(rig, 16.138, {method, tolerance});
  bench.start(current_mA(0));
  for (int k = 0; k < 300; ++k) bench.hold(current_mA(k));
  return bench.flow.state;
}

class EitherMethod : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(BothMethods, EitherMethod, testing::Values(Method::erk, Method::cvode),
                         [](const auto& p) { return p.param == Method::erk ? "erk" : "cvode"; });

TEST_P(EitherMethod, ConvergesWithItsTolerance) {
  const double exact = end_of_ride(GetParam(), solver::tightest_tolerance).joint.contraction_ratio;
  const auto error = [&](double tolerance) {
    return std::abs(end_of_ride(GetParam(), tolerance).joint.contraction_ratio - exact);
  };
  EXPECT_LT(error(1e-6), 1e-6);
  EXPECT_LT(error(1e-8), 1e-8);
  EXPECT_LT(error(1e-10), 1e-9);
}

TEST(Methods, AgreeWithEachOther) {
  const auto erk = end_of_ride(Method::erk, 1e-10), cvode = end_of_ride(Method::cvode, 1e-10);
  EXPECT_NEAR(erk.joint.contraction_ratio, cvode.joint.contraction_ratio, 1e-9);
  EXPECT_NEAR(erk.joint.contraction_speed_per_s, cvode.joint.contraction_speed_per_s, 1e-7);
  EXPECT_NEAR(erk.side.valve_pressure_Pa, cvode.side.valve_pressure_Pa, 1e-2);
  EXPECT_NEAR(erk.side.muscle_pressure_Pa, cvode.side.muscle_pressure_Pa, 1e-2);
  EXPECT_NEAR(erk.side.bristle_m, cvode.side.bristle_m, 1e-12);
}

// After a long rest the steps are as long as they get; a pulse of one tick must still be felt in full.
TEST_P(EitherMethod, NeverMissesAPulseOfOneTick) {
  RigOnBench bench(plant::Rig{}, 16.138, {GetParam(), Settings{}.tolerance});
  bench.start(8.0);
  bench.hold(8.0, 1000);
  RigOnBench exact(plant::Rig{}, 16.138, {GetParam(), 1e-11});
  exact.start(8.0);
  exact.hold(8.0, 1000);
  const double before_Pa = bench.flow.state.side.valve_pressure_Pa;
  for (auto* rig : {&bench, &exact}) rig->hold(20.0);
  EXPECT_GT(bench.flow.state.side.valve_pressure_Pa - before_Pa, 0.3e5);
  EXPECT_NEAR(bench.flow.state.side.valve_pressure_Pa, exact.flow.state.side.valve_pressure_Pa, 10.0);
  for (auto* rig : {&bench, &exact}) rig->hold(8.0, 5);
  EXPECT_NEAR(bench.flow.state.joint.contraction_ratio, exact.flow.state.joint.contraction_ratio, 1e-6);
}

TEST_P(EitherMethod, TakesTheSameStepsWithAndWithoutTheLedger) {
  const Settings settings{GetParam(), 1e-6};
  RigOnBench plain(plant::Rig{}, 11.138, settings), audited(plant::Rig{}, 11.138, settings, true);
  for (auto* bench : {&plain, &audited}) {
    bench->start(4.0);
    for (int k = 0; k < 200; ++k) bench->hold(current_mA(k));
  }
  // Explicit steps are the same to the bit; Newton's larger system rounds differently.
  if (GetParam() == Method::erk)
    EXPECT_EQ(std::memcmp(&plain.flow.state, &audited.flow.state, sizeof plain.flow.state), 0);
  else
    EXPECT_NEAR(plain.flow.state.joint.contraction_ratio, audited.flow.state.joint.contraction_ratio, 1e-7);
  EXPECT_EQ(plain.flow.ledger.air_drawn_kg, 0.0);
  EXPECT_GT(audited.flow.ledger.air_drawn_kg, 0.0);
}

TEST_P(EitherMethod, FailureNamesTimeStateAndCause) {
  RigOnBench bench(plant::Rig{}, 11.138, {GetParam(), 1e-6});
  bench.start(4.0);
  bench.hold(4.0, 10);
  bench.flow.state.joint.contraction_ratio = 0.9;  // past the braid's shortest length
  try {
    bench.hold(4.0);
    FAIL() << "integrated where no law is defined";
  } catch (const NumericalFailure& failure) {
    const std::string text = failure.what();
    EXPECT_NEAR(failure.time_s, 0.12, 1e-12);
    EXPECT_TRUE(holds(text, "t = 0.12 s", "contraction_ratio = 0.9",
                      "left the range in which the rig's laws are defined"));
  }
}

// A small controlled volume lets trial stages overshoot below vacuum;
// a smaller step must do, with either method.
TEST_P(EitherMethod, RecoversFromTrialStatesOutsideTheDomain) {
  plant::Rig rig;
  rig.valve.volume_m3 = 0.65e-6;
  rig.friction.memory = plant::FrictionMemory::coulomb;
  rig.friction.scale = 16.0;
  RigOnBench bench(rig, 16.0, {GetParam(), 1e-6});
  bench.start(4.0);
  bench.hold(4.0, 40);
  bench.hold(20.0, 40);
  EXPECT_NEAR(bench.flow.state.side.muscle_pressure_Pa, 5e5, 100.0);
}

TEST(Automatic, TellsWhatBothMethodsSaid) {
  RigOnBench bench(plant::Rig{}, 11.138, {Method::automatic, 1e-6});
  bench.start(4.0);
  bench.flow.state.joint.contraction_ratio = 0.9;
  try {
    bench.hold(4.0);
    FAIL();
  } catch (const NumericalFailure& failure) {
    EXPECT_TRUE(holds(failure.cause, "ERKStep", "CVODE"));
    EXPECT_TRUE(lacks(failure.cause, "try method: cvode"));
  }
}

TEST(Automatic, StaysExplicitOnTheNominalRig) {
  RigOnBench bench(plant::Rig{}, 16.138, {Method::automatic, 1e-6});
  bench.start(current_mA(0));
  for (int k = 0; k < 200; ++k) bench.hold(current_mA(k));
  EXPECT_EQ(bench.integrator->counters().stiff_from_tick, -1);
  EXPECT_EQ(bench.integrator->counters().jacobians, 0);
}

TEST(Automatic, GoesOverToBdfWhenTheBristlesAreStiff) {
  plant::Rig rig;
  rig.friction.bristle_stiffness_N_per_m = 1e7;
  RigOnBench bench(rig, 16.138, {Method::automatic, 1e-6});
  bench.start(current_mA(0));
  for (int k = 0; k < 300; ++k) bench.hold(current_mA(k));
  EXPECT_GT(bench.integrator->counters().stiff_from_tick, 0);
  EXPECT_NEAR(bench.flow.state.joint.contraction_ratio,
              end_of_ride(Method::erk, 1e-9, rig).joint.contraction_ratio, 2e-6);
}

}  // namespace
}  // namespace mckibben::engine
