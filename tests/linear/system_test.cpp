// Linear systems against closed forms.
#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <sim/linear/system.hpp>

namespace mckibben::linear {
namespace {

/// 1/(1 + T s)
System lag(double time_s) {
  return {Matrix::Constant(1, 1, -1.0 / time_s), Matrix::Constant(1, 1, 1.0 / time_s), Matrix::Ones(1, 1),
          Matrix::Zero(1, 1)};
}

/// (s + 3) / (s^2 + 2 s + 5)
System swinging() {
  System one{Matrix(2, 2), Matrix(2, 1), Matrix(1, 2), Matrix::Zero(1, 1)};
  one.A << 0.0, 1.0, -5.0, -2.0;
  one.B << 0.0, 1.0;
  one.C << 3.0, 1.0;
  return one;
}

TEST(System, HasThePolesZerosAndGainsOfItsFraction) {
  const auto roots = poles(swinging());
  ASSERT_EQ(roots.size(), 2u);
  EXPECT_NEAR(std::abs(roots[0] - Complex(-1.0, -2.0)), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(roots[1] - Complex(-1.0, 2.0)), 0.0, 1e-12);
  const auto nulls = zeros(swinging());
  ASSERT_EQ(nulls.size(), 1u);
  EXPECT_NEAR(std::abs(nulls[0] - Complex(-3.0, 0.0)), 0.0, 1e-12);
  EXPECT_NEAR(gain_at_rest(swinging()), 0.6, 1e-6);
  const Complex s(0.0, 1.7);
  EXPECT_NEAR(std::abs(response(swinging(), 1.7) - (s + 3.0) / (s * s + 2.0 * s + 5.0)), 0.0, 1e-12);
}

/// A memory that holds has a pole and a zero at 0, which the eigenvalues of turned axes are only nearly.
TEST(System, HasAPoleAndAZeroAtZeroWhereNothingLessIsResolved) {
  System one{Matrix::Zero(4, 4), Matrix::Zero(4, 1), Matrix::Zero(1, 4), Matrix::Zero(1, 1)};
  one.A.topLeftCorner(2, 2) = swinging().A;
  one.A(2, 3) = 1000.0;
  one.A(3, 3) = -1000.0;
  one.B << 0.0, 1.0, 0.0, 1.0;
  one.C << 3.0, 1.0, 0.5, 0.0;
  Matrix axes(4, 4);
  axes << 1.0, 0.3, -0.2, 0.7, 0.1, 1.0, 0.4, -0.6, 0.5, -0.3, 1.0, 0.2, -0.4, 0.8, 0.6, 1.0;
  one = {axes * one.A * axes.inverse(), axes * one.B, one.C * axes.inverse(), one.D};
  EXPECT_EQ(poles(one).front(), Complex(0.0));
  const System pure = in_series(one, lag(1.0));
  EXPECT_EQ(poles(pure).front(), Complex(0.0));
  for (const Complex& zero : zeros(one)) EXPECT_TRUE(zero == Complex(0.0) || std::abs(zero) > 1e-6) << zero;
}

/// However many poles there are more than zeros, none comes from far away.
TEST(System, HasNoZerosThatItsFractionHasNot) {
  System chain = lag(0.5);
  for (const double time_s : {0.1, 2.0, 1e-3, 0.03}) chain = in_series(chain, lag(time_s));
  EXPECT_TRUE(zeros(chain).empty());
  const auto nulls = zeros(in_series(chain, swinging()));
  ASSERT_EQ(nulls.size(), 1u);
  EXPECT_NEAR(std::abs(nulls[0] - Complex(-3.0, 0.0)), 0.0, 1e-6);
  chain.B.setZero();
  EXPECT_TRUE(zeros(chain).empty());
}

TEST(System, InSeriesAndClosedAsTheirFractions) {
  const System loop = in_series(lag(0.5), swinging());
  for (const double w : {0.3, 2.0, 9.0}) {
    const Complex open = response(lag(0.5), w) * response(swinging(), w);
    EXPECT_NEAR(std::abs(response(loop, w) - open), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(response(closed(loop), w) - open / (1.0 + open)), 0.0, 1e-12);
  }
  EXPECT_TRUE(is_stable(closed(loop)));
  System away = lag(0.5);
  away.A *= -1.0;
  EXPECT_FALSE(is_stable(away));
}

/// A lag under a held command that comes late: between samples the first part is still of the one before.
TEST(System, SampledIsWhatAHeldAndLateCommandDoes) {
  const double T = 0.4, h = 0.1;
  for (const double late : {0.0, 0.1, 0.03, 0.27}) {
    const System digital = sampled(lag(T), h, late);
    EXPECT_EQ(digital.step_s, h);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(digital.states());
    for (int k = 0; k < 12; ++k) {
      const double since_s = k * h - late;
      EXPECT_NEAR((digital.C * x)(0), since_s > 0.0 ? 1.0 - std::exp(-since_s / T) : 0.0, 1e-12)
          << late << " " << k;
      x = digital.A * x + digital.B * 1.0;
    }
  }
}

/// x' = a x + u, cost x^2 + u^2: P = a^2 P - a^2 P^2/(1 + P) + 1.
TEST(System, LeastSquaresFeedbackSolvesTheScalarRiccatiEquation) {
  for (const double a : {0.5, 1.0, 1.4}) {
    const System one{Matrix::Constant(1, 1, a), Matrix::Ones(1, 1), Matrix::Ones(1, 1), Matrix::Zero(1, 1),
                     0.1};
    const double P = 0.5 * (a * a + std::sqrt(a * a * a * a + 4.0));
    EXPECT_NEAR(least_squares_feedback(one)(0, 0), a * P / (1.0 + P), 1e-12) << a;
  }
}

}  // namespace
}  // namespace mckibben::linear
