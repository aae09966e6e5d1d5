// Closed forms of the braid: T 2.9, 2.10, 4.3 and virtual work.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <plant/geometry.hpp>

namespace mckibben::plant {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Geometry, LargestContractionMakesTheForceVanish) {
  const Braid braid{Muscle{}};
  // T 2.10 written out for 20 degrees and k = 1.3.
  const double ratio = (1.0 - std::sqrt((1.0 / std::pow(std::sin(20 * pi / 180), 2)) /
                                        (3.0 / std::pow(std::tan(20 * pi / 180), 2)))) /
                       1.3;
  EXPECT_NEAR(braid.largest_contraction_ratio(), ratio, 1e-15);
  EXPECT_NEAR(braid.largest_contraction_ratio(), 0.297, 5e-4);
  EXPECT_NEAR(braid.force_N(braid.largest_contraction_ratio(), 5e5), 0.0, 1e-9);
}

TEST(Geometry, LargestForceIsTheForceAtRest) {
  const Braid braid{Muscle{}};
  const double tangent = std::tan(20 * pi / 180), sine = std::sin(20 * pi / 180);
  const double expected = pi * 7.5e-3 * 7.5e-3 * 5e5 * (3.0 / (tangent * tangent) - 1.0 / (sine * sine));
  EXPECT_NEAR(braid.largest_force_N(5e5), expected, 1e-9 * expected);  // T 2.9
  EXPECT_NEAR(braid.force_N(0.0, 5e5), expected, 1e-9 * expected);
}

TEST(Geometry, PneumaticWorkIsMechanicalWork) {
  const Braid braid{Muscle{}};
  for (double e = -0.02; e < 0.29; e += 0.01) {
    const double h = 1e-6, P = 3e5;
    const double slope = (braid.volume_m3(e + h) - braid.volume_m3(e - h)) / (2 * h);
    EXPECT_NEAR(slope, braid.volume_slope_m3(e), 1e-8 * std::abs(braid.volume_slope_m3(0.0)));
    EXPECT_NEAR(P * braid.volume_slope_m3(e), braid.force_N(e, P) * 0.3, 1e-9);  // P dV = F l0 de
  }
}

TEST(Geometry, EndsPullNothing) {
  Muscle muscle;
  const Braid whole{muscle};
  muscle.end_length_m = 0.060;
  const Braid braid{muscle};
  for (double e = -0.02; e < 0.29; e += 0.05) {
    EXPECT_NEAR(braid.force_N(e, 3e5), 0.8 * whole.force_N(e, 3e5), 1e-9);
    EXPECT_NEAR(3e5 * braid.volume_slope_m3(e), braid.force_N(e, 3e5) * 0.3, 1e-9);
  }
  EXPECT_DOUBLE_EQ(braid.volume_m3(0.0), whole.volume_m3(0.0));
  EXPECT_DOUBLE_EQ(braid.largest_contraction_ratio(), whole.largest_contraction_ratio());
}

TEST(Geometry, ContactSurfaceAtRestIsTheTubesLateralSurface) {
  Muscle muscle;
  const double tube = 2.0 * pi * muscle.rest_radius_m * muscle.rest_length_m;
  EXPECT_NEAR(Braid{muscle}.contact_surface_m2(0.0), tube, 1e-15);
  muscle.contact_surface = ContactSurface::printed;  // as the thesis prints it: 39 % too large
  EXPECT_NEAR(Braid{muscle}.contact_surface_m2(0.0) / tube, 1.39, 0.005);
}

TEST(Geometry, DomainEndsWhereALawDoes) {
  for (const double dead_volume_m3 : {0.0, 5e-6}) {
    Muscle muscle;
    muscle.dead_volume_m3 = dead_volume_m3;
    const Braid braid{muscle};
    EXPECT_TRUE(braid.in_domain(0.0));
    EXPECT_TRUE(braid.in_domain(0.297));
    EXPECT_FALSE(braid.in_domain(1.0 / 1.3));
    EXPECT_FALSE(braid.in_domain(std::nan("")));
    for (double e = -0.2; e < 0.9; e += 1e-3)
      if (braid.in_domain(e)) {
        EXPECT_GT(braid.volume_m3(e), 0.0) << e;
        EXPECT_TRUE(std::isfinite(braid.contact_surface_m2(e))) << e;
      }
  }
}

}  // namespace
}  // namespace mckibben::plant
