// The Jacobian by dual numbers against differences, at random states away from kinks; shared by the tests of
// this room.
#pragma once

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <sim/engine/jacobian.hpp>

namespace mckibben::engine {

/// Where a valve's pressure is its muscle's, the hose's flow turns round, and with it whose temperature the
/// gas has: a kink. No difference may reach across it.
template <class L>
void keep_apart(std::array<double, L::size>& y, std::size_t valve) {
  const double reach = 1e-5 * size_of<L>(static_cast<int>(valve));
  if (std::abs(y[valve] - y[valve + 1]) < reach) y[valve] = y[valve + 1] + reach;
}

/// At 200 random states.
template <class L>
void expect_slopes(const plant::Rig& rig) {
  constexpr int n = L::size;
  std::mt19937_64 random(20);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  const plant::Plant plant = L::sides == 1 ? plant::plant_of(rig, 15.0) : plant::Plant(rig, rig, {});
  Problem<L> problem(plant);
  for (int trial = 0; trial < 200; ++trial) {
    problem.held.reference_pressure_Pa = between(0.5e5, 5e5);
    problem.held.opposite.reference_pressure_Pa = between(0.5e5, 5e5);
    std::array<double, n> y{between(-0.01, 0.25), between(0.05, 1.0) * (trial % 2 ? 1 : -1),
                            between(0.5e5, 5e5), between(0.5e5, 5e5), between(-1e-4, 1e-4)};
    for (int i = plant::single_size; i < L::steering; ++i)
      y[static_cast<std::size_t>(i)] = between(0.1, 0.9) * size_of<L>(i);
    keep_apart<L>(y, 2);
    if constexpr (L::sides == 2) keep_apart<L>(y, 5);
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

}  // namespace mckibben::engine
