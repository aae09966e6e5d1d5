// A sealed muscle, valve: {kind: none}: its gas against closed forms, shut for an hour, and leaking.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <sim/ride/ride.hpp>

namespace mckibben::ride {
namespace {

constexpr double open_air_Pa = 101325.0, RT_J_per_kg = 287.05 * 293.15, normal_kg_per_m3 = 1.185;
constexpr double fill_Pa = 3e5;

plant::Rig sealed() {
  plant::Rig rig;
  rig.valve.kind = plant::ValveKind::none;
  rig.valve.fill_pressure_Pa = fill_Pa;
  rig.valve.resolve();
  return rig;
}

Drive at_ratio(double contraction_ratio) {
  Drive drive;
  drive.contraction_ratio = contraction_ratio;
  return drive;
}

class Sealed : public testing::TestWithParam<solver::Method> {
 protected:
  Ride ride(const plant::Rig& rig) { return Ride(Loaded{rig, 10.0}, {GetParam(), 1e-9}, true); }
  /// From rest length at 3 bar to a contraction of 0.2, in so long.
  Ride stretched(const plant::Rig& rig, double in_s) {
    Ride one = ride(rig);
    one.start(at_ratio(0.0), 0.0);
    one.step(at_ratio(0.2), in_s);
    return one;
  }
  static double muscle_Pa(const Ride& ride) { return ride.flow().state.side.muscle_pressure_Pa; }
  /// Absolute, of gas that keeps p V^n.
  static double expected_Pa(const Ride& ride, double n) {
    const plant::Braid& braid = ride.plant().side().braid();
    return (fill_Pa + open_air_Pa) * std::pow(braid.volume_m3(0.0) / braid.volume_m3(0.2), n);
  }
};

TEST_P(Sealed, KeepsPTimesVWhileItsLengthChanges) {
  const Ride moved = stretched(sealed(), 1.0);
  const double expected = expected_Pa(moved, 1.0);
  EXPECT_LT(expected, fill_Pa);
  EXPECT_NEAR(muscle_Pa(moved) + open_air_Pa, expected, 1e-6 * expected);
  EXPECT_EQ(moved.flow().ledger.air_drawn_kg, 0.0);
}

TEST_P(Sealed, IsAPolytropeOfItsExponent) {
  plant::Rig rig = sealed();
  rig.effects.get<plant::PolytropicGas>().exponent = 1.4;
  const Ride moved = stretched(rig, 1.0);
  EXPECT_NEAR(muscle_Pa(moved) + open_air_Pa, expected_Pa(moved, 1.4), 1.0);
}

// Quicker than heat goes it is adiabatic; as long after as heat takes to go, isothermal.
TEST_P(Sealed, GoesFromAdiabaticToIsothermal) {
  plant::Rig rig = sealed();
  rig.effects.get<plant::GasTemperature>().time_s = 1.0;
  Ride moved = stretched(rig, 1e-4);
  EXPECT_NEAR(muscle_Pa(moved) + open_air_Pa, expected_Pa(moved, 1.4), 30.0);
  for (int k = 1; k <= 20; ++k) moved.step(at_ratio(0.2), k);
  EXPECT_NEAR(muscle_Pa(moved) + open_air_Pa, expected_Pa(moved, 1.0), 1.0);
}

TEST_P(Sealed, CarriesALoadAsASpring) {
  plant::Rig rig = sealed();
  Ride held = ride(rig);
  const Drive filling = ride::settling({}, rig);
  held.start(filling, -2.0);
  for (int k = 1; k <= 100; ++k) held.step(filling, -2.0 + 0.02 * k);
  EXPECT_EQ(muscle_Pa(held), fill_Pa);  // as long as something fills it
  const plant::Braid& braid = held.plant().side().braid();
  const auto gas_Pa_m3 = [&] {
    return (muscle_Pa(held) + open_air_Pa) * braid.volume_m3(held.flow().state.joint.contraction_ratio);
  };
  const double filled = gas_Pa_m3(), before = held.flow().state.joint.contraction_ratio;
  EXPECT_GT(before, 0.1);
  held.open_ledger();
  const plant::State<double> from = held.flow().state;
  Drive pulled;
  pulled.joint_force_N = 100.0;
  for (int k = 1; k <= 100; ++k) held.step(pulled, 0.02 * k);
  EXPECT_LT(held.flow().state.joint.contraction_ratio, before - 0.01);
  EXPECT_GT(muscle_Pa(held), fill_Pa + 1e4);
  EXPECT_NEAR(gas_Pa_m3(), filled, 1e-6 * filled);
  const plant::Imbalance left = held.plant().imbalance(from, held.flow().state, held.flow().ledger);
  EXPECT_LT(std::abs(left.gas), 1e-6);
  EXPECT_LT(std::abs(left.energy), 1e-3);
}

// V dP/dt = - R T C rho0 P sqrt(1 - x^2), x = (P_a/P - b)/(1 - b), 0 as long as it is choked. With x = sin u
// and c = b/(1 - b): du/dt = k (c + sin u), whose integral is a logarithm.
TEST_P(Sealed, LeaksToAmbientAsIso6358Says) {
  plant::Rig rig = sealed();
  const double conductance = 1e-10, b = 0.3;
  rig.effects.get<plant::MuscleLeak>().conductance_m3_per_s_Pa = conductance;
  Ride leaking = ride(rig);
  leaking.start(at_ratio(0.1), 0.0);
  const double k_per_s =
      RT_J_per_kg * conductance * normal_kg_per_m3 / leaking.plant().side().braid().volume_m3(0.1);
  const double choked_s = std::log((fill_Pa + open_air_Pa) / (open_air_Pa / b)) / k_per_s;
  ASSERT_GT(choked_s, 0.5);
  leaking.step(at_ratio(0.1), 0.5 * choked_s);
  const double halfway_Pa = (fill_Pa + open_air_Pa) * std::exp(-0.5 * k_per_s * choked_s);
  EXPECT_NEAR(muscle_Pa(leaking) + open_air_Pa, halfway_Pa, 1e-6 * halfway_Pa);
  const double then_Pa = 1.2 * open_air_Pa, c = b / (1.0 - b), root = std::sqrt(1.0 - c * c);
  const auto integral = [&](double x) {
    const double half = std::tan(0.5 * std::asin(x));
    return std::log((c * half + 1.0 - root) / (c * half + 1.0 + root)) / root;
  };
  const double x = (open_air_Pa / then_Pa - b) / (1.0 - b);
  leaking.step(at_ratio(0.1), choked_s + (integral(x) - integral(0.0)) / k_per_s);
  EXPECT_NEAR(muscle_Pa(leaking) + open_air_Pa, then_Pa, 1e-5 * then_Pa);
}

TEST_P(Sealed, WithoutMotionNothingChangesInAnHour) {
  Ride shut = ride(sealed());
  shut.start(at_ratio(0.1), 0.0);
  for (int minute = 1; minute <= 60; ++minute) shut.step(at_ratio(0.1), 60.0 * minute);
  EXPECT_EQ(muscle_Pa(shut), fill_Pa);
}

INSTANTIATE_TEST_SUITE_P(BothMethods, Sealed, testing::Values(solver::Method::erk, solver::Method::cvode),
                         [](const auto& p) { return p.param == solver::Method::erk ? "erk" : "cvode"; });

TEST(SealedMuscle, HoldsItsLoadForAnHour) {
  const plant::Rig rig = sealed();
  Ride held(Loaded{rig, 10.0}, {solver::Method::cvode, 1e-9}, true);
  const Drive filling = ride::settling({}, rig);
  held.start(filling, -20.0);
  for (int k = 1; k <= 200; ++k) held.step(filling, -20.0 + 0.1 * k);
  const auto before = held.flow().state;
  const plant::Braid& braid = held.plant().side().braid();
  for (int minute = 1; minute <= 60; ++minute) held.step({}, 60.0 * minute);
  const auto& after = held.flow().state;
  const auto gas_Pa_m3 = [&](const plant::State<double>& state) {
    return (state.side.muscle_pressure_Pa + open_air_Pa) * braid.volume_m3(state.joint.contraction_ratio);
  };
  EXPECT_NEAR(gas_Pa_m3(after), gas_Pa_m3(before), 1e-9 * gas_Pa_m3(before));
  EXPECT_NEAR(after.side.muscle_pressure_Pa, before.side.muscle_pressure_Pa, 1.0);
  EXPECT_NEAR(after.joint.contraction_ratio, before.joint.contraction_ratio, 1e-6);
}

}  // namespace
}  // namespace mckibben::ride
