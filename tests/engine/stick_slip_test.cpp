// Exact Coulomb friction: the load sticks without creeping, breaks away at the level, and needs few events.
#include <cmath>

#include <gtest/gtest.h>

#include "rig_on_bench.hpp"

namespace mckibben::engine {
namespace {

plant::Rig coulomb_rig() {
  plant::Rig rig;
  rig.friction.memory = plant::FrictionMemory::coulomb;
  return rig;
}

class StickSlip : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(AllMethods, StickSlip,
                         testing::Values(Method::erk, Method::cvode, Method::automatic), [](const auto& p) {
                           return p.param == Method::erk     ? "erk"
                                  : p.param == Method::cvode ? "cvode"
                                                             : "automatic";
                         });

TEST_P(StickSlip, HoldsTheLoadStillAndBreaksAwayAtTheLevel) {
  RigOnBench bench(coulomb_rig(), 16.138, {GetParam(), 1e-7});
  bench.start(4.0);
  bench.hold(4.0, 50);
  for (int k = 0; k < 200; ++k) bench.hold(4.0 + 0.05 * k);  // up to 14 mA, moving
  bench.hold(14.0, 200);
  ASSERT_EQ(bench.held.slip, plant::Slip::sticking);
  const double e = bench.flow.state.joint.contraction_ratio;
  EXPECT_EQ(bench.flow.state.joint.contraction_speed_per_s, 0.0);

  // The pressure falls slowly until the threads can no longer hold the load.
  double last_margin_N = 0.0;
  int k = 0;
  for (; k < 2000 && bench.held.slip == plant::Slip::sticking; ++k) {
    EXPECT_EQ(bench.flow.state.joint.contraction_ratio, e);
    last_margin_N = bench.plant.event_margin(bench.flow.state, bench.flow.memory, bench.held);
    EXPECT_GT(last_margin_N, 0.0);
    bench.hold(14.0 - 0.002 * k);
  }
  EXPECT_EQ(bench.held.slip, plant::Slip::falling);
  EXPECT_GT(k, 50);
  EXPECT_LT(last_margin_N, 0.5);  // one tick before it broke away there was next to nothing left
}

TEST_P(StickSlip, FollowsTheBristlesOnASlowRideButForTheirDeflection) {
  const auto ride = [&](const plant::Rig& rig) {
    RigOnBench bench(rig, 16.138, {GetParam(), 1e-7});
    bench.start(4.0);
    std::array<double, 4> e{};
    for (int k = 0; k < 1600; ++k) {
      bench.hold(4.0 + 14.0 * (1.0 - std::abs(k - 800) / 800.0));
      if (k % 400 == 399) e[static_cast<std::size_t>(k / 400)] = bench.flow.state.joint.contraction_ratio;
    }
    EXPECT_LT(bench.integrator->counters().events, 40);
    return e;
  };
  const auto exact = ride(coulomb_rig()), bristles = ride(plant::Rig{});
  for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_NEAR(exact[i], bristles[i], 2.5e-3) << i;
  EXPECT_GT(exact[2] - exact[0], 0.005);  // the loop is open: lower when going up than when coming down
}

// From a start the wrong way the speed never falls through zero: friction once pushed such a load along.
TEST_P(StickSlip, FrictionNeverPushesALoadThatStartsTheWrongWay) {
  RigOnBench bench(coulomb_rig(), 11.138, {GetParam(), 1e-7});
  bench.start(4.0);
  bench.hold(12.0, 60);
  bench.held.slip = plant::Slip::falling;  // and yet the muscle lifts it
  bench.flow.state.joint.contraction_speed_per_s = 0.0;
  for (int k = 0; k < 20; ++k) {
    bench.hold(20.0);
    const double speed = bench.flow.state.joint.contraction_speed_per_s;
    const auto now = bench.plant.moment(bench.flow.state, bench.held);
    EXPECT_LE(now.friction_force_N * speed, 1e-6) << k;
  }
}

TEST(StickSlip, MethodsAgree) {
  const auto end = [](Method method) {
    RigOnBench bench(coulomb_rig(), 11.138, {method, 1e-9});
    bench.start(4.0);
    for (int k = 0; k < 500; ++k) bench.hold(12.0 + 7.0 * std::sin(0.03 * k));
    return bench.flow.state.joint.contraction_ratio;
  };
  EXPECT_NEAR(end(Method::erk), end(Method::cvode), 1e-6);
}

}  // namespace
}  // namespace mckibben::engine
