// The Jacobian by dual numbers against differences, at random states away from kinks.
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <sim/engine/jacobian.hpp>

#include "switched_on.hpp"

namespace mckibben::engine {
namespace {

/// At 200 random states.
template <class L>
void expect_slopes(const plant::Rig& rig) {
  constexpr int n = L::size;
  std::mt19937_64 random(20);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  const plant::Plant plant = L::sides == 1 ? plant::Plant(rig, 15.0) : plant::Plant(rig, rig, {});
  Problem<L> problem(plant);
  for (int trial = 0; trial < 200; ++trial) {
    problem.held.reference_pressure_Pa = between(0.5e5, 5e5);
    problem.held.opposite.reference_pressure_Pa = between(0.5e5, 5e5);
    std::array<double, n> y{between(-0.01, 0.25), between(0.05, 1.0) * (trial % 2 ? 1 : -1),
                            between(0.5e5, 5e5), between(0.5e5, 5e5), between(-1e-4, 1e-4)};
    for (int i = plant::single_size; i < L::steering; ++i)
      y[static_cast<std::size_t>(i)] = between(0.1, 0.9) * size_of<L>(i);
    Eigen::Matrix<double, n, n> exact;
    ASSERT_TRUE(jacobian(problem, y.data(), exact));
    for (int column = 0; column < L::steering; ++column) {
      const auto j = static_cast<std::size_t>(column);
      const double h = 1e-6 * size_of<L>(column);
      std::array<double, n> up = y, down = y, f_up{}, f_down{};
      up[j] += h;
      down[j] -= h;
      ASSERT_TRUE(problem.rates(up.data(), f_up.data()) && problem.rates(down.data(), f_down.data()));
      for (int row = 0; row < n; ++row) {
        const auto i = static_cast<std::size_t>(row);
        const double slope = (f_up[i] - f_down[i]) / (2.0 * h);
        const double size = std::abs(slope) + (std::abs(f_up[i]) + 1e-12) / size_of<L>(column);
        EXPECT_NEAR(exact(row, column), slope, 2e-5 * size) << "row " << row << " column " << column;
      }
    }
  }
}

TEST(Jacobian, IsTheSlopeOfTheEquations) {
  for (const auto law : {plant::FrictionLaw::superposition, plant::FrictionLaw::area,
                         plant::FrictionLaw::logarithmic, plant::FrictionLaw::power}) {
    plant::Rig rig;
    rig.friction.law = law;
    expect_slopes<Layout<1, false, Books::isothermal>>(rig);
  }
}

TEST(Jacobian, KnowsEveryEffectAndWhatItRemembers) {
  expect_slopes<Layout<1, true, Books::polytropic>>(plant::rig_with_all_effects());
  for (const auto& [name, rig] : plant::rigs_with_one_effect()) {
    SCOPED_TRACE(name);
    if (plant::Plant(rig, 15.0).remembers())
      expect_slopes<Layout<1, true, Books::none>>(rig);
    else
      expect_slopes<Layout<1, false, Books::none>>(rig);
  }
}

TEST(Jacobian, KnowsTwoMuscles) {
  expect_slopes<Layout<2, true, Books::polytropic>>(plant::Rig{});
  expect_slopes<Layout<2, true, Books::polytropic>>(plant::rig_with_all_effects());
}

TEST(Jacobian, IsRefusedOutsideTheDomain) {
  const plant::Plant plant(plant::Rig{}, 15.0);
  const Problem<Layout<1, false, Books::none>> problem(plant);
  const std::array<double, plant::single_size> y{0.9, 0.0, 1e5, 1e5, 0.0};
  Eigen::Matrix<double, plant::single_size, plant::single_size> result;
  EXPECT_FALSE(jacobian(problem, y.data(), result));
}

}  // namespace
}  // namespace mckibben::engine
