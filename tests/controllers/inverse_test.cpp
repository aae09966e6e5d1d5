// The inverse of a planted pressure model gives back the planted current speed and pressure; the right root
// of the quadratic; limits that are marked.
#include <cmath>

#include <gtest/gtest.h>

#include <controllers/inverse.hpp>

#include "planted.hpp"

namespace mckibben::controllers {
namespace {

const ValveLine valve{4.0, 20.0, 0.5e5, 5.0e5};
constexpr double slope_Pa_per_mA = 4.5e5 / 16.0;

// dP/de of the model at a constant nu, by differences of the pressure itself.
double slope_Pa(const Inverse& inverse, Branch branch, double e, double nu) {
  constexpr double step = 1e-6;
  return (inverse.pressure_Pa(branch, e + step, nu) - inverse.pressure_Pa(branch, e - step, nu)) /
         (2.0 * step);
}

// Contraction speed in a ramp of the current at nu: dP/dt = dP/de de/dt.
double ramp_per_s(const Inverse& inverse, Branch branch, double e, double nu) {
  const double speed = slope_Pa_per_mA * nu / slope_Pa(inverse, branch, e, nu);
  return branch == Branch::contraction ? speed : -speed;
}

void expect_round_trip(const Inverse& inverse, Branch branch) {
  for (const double e : {0.03, 0.08, 0.12, 0.18})
    for (const double nu : {5.5, 8.0, 12.0, 16.5}) {
      const Answer answer = inverse(branch, e, ramp_per_s(inverse, branch, e, nu));
      EXPECT_NEAR(answer.current_speed_mA_per_s, nu, 1e-6 * nu) << "at e = " << e;
      EXPECT_NEAR(answer.pressure_Pa, inverse.pressure_Pa(branch, e, nu), 1.0) << "at e = " << e;
      EXPECT_FALSE(answer.ratio_outside || answer.speed_outside || answer.unreachable);
    }
}

TEST(Inverse, PressureModelIsTheThesissSum) {
  const Inverse inverse(planted_calibration(), 16.0, valve, false);
  const double a0 = 6.8e4, a1 = 2160.0 * 8.0 + 4.2e5, a2 = 36.0 * 8.0 + 9e3, a3 = 10.4, a4 = 4.2e3;
  EXPECT_NEAR(inverse.pressure_Pa(Branch::contraction, 0.1, 8.0),
              a0 + a1 * 0.1 + a2 * std::exp(a3 * 0.1) + a4 * std::log(0.1), 1e-6);
  const double b0 = -1300.0 * 8.0 + 5.2e4, b1 = 4e5, b2 = 7200.0, b3 = 11.4,
               b4 = 80.0 * 64.0 - 220.0 * 8.0 + 3.6e3;
  EXPECT_NEAR(inverse.pressure_Pa(Branch::relaxation, 0.1, 8.0),
              b0 + b1 * 0.1 + b2 * std::exp(b3 * 0.1) + b4 * std::log(0.1), 1e-6);
}

TEST(Inverse, GivesBackThePlantedSpeedAndPressureOnBothBranches) {
  for (const double load_kg : {11.138, 16.138, 23.406}) {
    const Inverse inverse(planted_calibration(), load_kg, valve, false);
    expect_round_trip(inverse, Branch::contraction);
  }
}

TEST(Inverse, OfRelaxationTakesTheOnlyPositiveRoot) {
  Calibration calibration = planted_calibration();
  calibration.relaxation.b4_0 = {-0.5, 0.0};  // roots of unlike sign
  expect_round_trip(Inverse(calibration, 16.138, valve, false), Branch::relaxation);
}

TEST(Inverse, OfRelaxationStaysExactWhereItIsLinear) {
  Calibration calibration = planted_calibration();
  calibration.relaxation.b4_0 = {0.0};
  expect_round_trip(Inverse(calibration, 16.138, valve, false), Branch::relaxation);
}

TEST(Inverse, OfTwoPositiveRootsTakesTheOneThatLeadsToRest) {
  const Calibration calibration = planted_calibration();
  const double load_kg = 16.0, e = 0.05, nu = 6.0;
  const Inverse inverse(calibration, load_kg, valve, false);
  const double w = ramp_per_s(inverse, Branch::relaxation, e, nu);
  const double q2 = 80.0 * w / e, q0 = slope_Pa(inverse, Branch::relaxation, e, 0.0) * w;
  const double other_root = q0 / (q2 * nu);  // the product of the roots is q0/q2
  ASSERT_GT(other_root, nu) << "the planted root must be the smaller one for this test";
  EXPECT_NEAR(inverse(Branch::relaxation, e, w).current_speed_mA_per_s, nu, 1e-6 * nu);
  // Continuously to rest: half the speed needs about half the current speed, not a faster one.
  const Inverse free(calibration, load_kg, valve, true);
  double before = nu;
  for (double share = 0.9; share > 0.05; share -= 0.1) {
    const double found = free(Branch::relaxation, e, share * w).current_speed_mA_per_s;
    EXPECT_LT(found, before);
    before = found;
  }
  EXPECT_LT(before, 0.2 * nu);
}

TEST(Inverse, SaysWhatNoCurrentSpeedReaches) {
  const Inverse inverse(planted_calibration(), 16.0, valve, false);
  const Answer down = inverse(Branch::relaxation, 0.05, -2.0);  // no real root
  EXPECT_TRUE(down.unreachable);
  EXPECT_EQ(down.current_speed_mA_per_s, 17.0);
  const Answer up = inverse(Branch::contraction, 0.1, 20.0);  // beyond the pole
  EXPECT_TRUE(up.unreachable);
  EXPECT_EQ(up.current_speed_mA_per_s, 17.0);
  EXPECT_TRUE(std::isfinite(up.pressure_Pa));
}

TEST(Inverse, KeepsToTheCalibratedRangeAndMarksWhatLiesOutside) {
  const Inverse inverse(planted_calibration(), 16.0, valve, false);
  const Answer low = inverse(Branch::contraction, 0.0, 0.1);
  EXPECT_TRUE(low.ratio_outside);
  EXPECT_NEAR(low.pressure_Pa, inverse.pressure_Pa(Branch::contraction, 0.02, low.current_speed_mA_per_s),
              1e-9);
  const Answer high = inverse(Branch::relaxation, 0.25, -0.1);
  EXPECT_TRUE(high.ratio_outside);
  const Answer slow = inverse(Branch::contraction, 0.1, 1e-3);
  EXPECT_TRUE(slow.speed_outside);
  EXPECT_FALSE(slow.ratio_outside);
  EXPECT_EQ(slow.current_speed_mA_per_s, 5.0);
}

TEST(Inverse, LeavesTheRangeOnlyWhenItMayAndMarksItStill) {
  const Inverse free(planted_calibration(), 16.0, valve, true);
  const double w = ramp_per_s(free, Branch::contraction, 0.22, 1.5);
  const Answer answer = free(Branch::contraction, 0.22, w);
  EXPECT_NEAR(answer.current_speed_mA_per_s, 1.5, 1e-6);
  EXPECT_NEAR(answer.pressure_Pa, free.pressure_Pa(Branch::contraction, 0.22, 1.5), 1.0);
  EXPECT_TRUE(answer.ratio_outside);
  EXPECT_TRUE(answer.speed_outside);
  EXPECT_TRUE(std::isfinite(free(Branch::contraction, 0.0, 0.1).pressure_Pa)) << "ln 0 is never taken";
}

TEST(FrictionModel, IsASumOfLinearAndLogarithmicParts) {
  const FrictionModel model{4.0, 0.5, -3.0, 2.0};
  EXPECT_NEAR(model.coefficient(0.1, 2.0), 4.0 + 0.5 * 4.0 - 0.3 + 2.0 * std::log(0.1), 1e-12);
}

TEST(AtLoad, TakesTheHighestPowerFirst) {
  EXPECT_EQ(at_load({2.0, -1.0, 3.0}, 10.0), 193.0);
  EXPECT_EQ(at_load({7.0}, 10.0), 7.0);
}

}  // namespace
}  // namespace mckibben::controllers
