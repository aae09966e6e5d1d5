// The Jacobian by dual numbers against differences, at random states away from kinks.
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <sim/engine/jacobian.hpp>

namespace mckibben::engine {
namespace {

TEST(Jacobian, IsTheSlopeOfTheEquations) {
  constexpr int n = plant::state_size + plant::ledger_size;
  std::mt19937_64 random(20);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  for (const auto law : {plant::FrictionLaw::superposition, plant::FrictionLaw::area,
                         plant::FrictionLaw::logarithmic, plant::FrictionLaw::power}) {
    plant::Rig rig;
    rig.friction.law = law;
    const plant::Plant plant(rig, 15.0);
    Problem<n> problem(plant);
    for (int trial = 0; trial < 200; ++trial) {
      problem.held.reference_pressure_Pa = between(0.5e5, 5e5);
      const std::array<double, n> y{between(-0.01, 0.25), between(0.05, 1.0) * (trial % 2 ? 1 : -1),
                                    between(0.5e5, 5e5), between(0.5e5, 5e5), between(-1e-4, 1e-4)};
      Eigen::Matrix<double, n, n> exact;
      ASSERT_TRUE(jacobian(problem, y.data(), exact));
      for (int column = 0; column < plant::state_size; ++column) {
        const auto j = static_cast<std::size_t>(column);
        const double h = 1e-6 * working_size[j];
        std::array<double, n> up = y, down = y, f_up{}, f_down{};
        up[j] += h;
        down[j] -= h;
        ASSERT_TRUE(problem.rates(up.data(), f_up.data()) && problem.rates(down.data(), f_down.data()));
        for (int row = 0; row < n; ++row) {
          const auto i = static_cast<std::size_t>(row);
          const double slope = (f_up[i] - f_down[i]) / (2.0 * h);
          const double size = std::abs(slope) + (std::abs(f_up[i]) + 1e-12) / working_size[j];
          EXPECT_NEAR(exact(row, column), slope, 2e-5 * size) << "row " << row << " column " << column;
        }
      }
    }
  }
}

TEST(Jacobian, IsRefusedOutsideTheDomain) {
  const plant::Plant plant(plant::Rig{}, 15.0);
  const Problem<plant::state_size> problem(plant);
  const std::array<double, plant::state_size> y{0.9, 0.0, 1e5, 1e5, 0.0};
  Eigen::Matrix<double, plant::state_size, plant::state_size> result;
  EXPECT_FALSE(jacobian(problem, y.data(), result));
}

}  // namespace
}  // namespace mckibben::engine
