// Least squares: planted numbers come back, errors and condition numbers are what they should be, and what
// the data cannot tell is said.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <sim/thesis/least_squares.hpp>

namespace mckibben::thesis {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

VectorXd noise(Eigen::Index n, double rms) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0.0, rms);
  VectorXd values(n);
  for (double& each : values) each = normal(random);
  return values;
}

TEST(LeastSquares, StandardErrorsAreThoseOfAStraightLine) {
  const VectorXd x = VectorXd::LinSpaced(400, 0.0, 1.0);
  const VectorXd y = 3.0 * x + VectorXd::Constant(400, -2.0) + noise(400, 0.1);
  const LinearFit fit = fit_polynomial(x, y, 1);
  const double textbook = fit.standard_deviation / std::sqrt((x.array() - x.mean()).square().sum());
  EXPECT_NEAR(fit.standard_errors(0), textbook, 1e-12);
  EXPECT_NEAR(fit.standard_deviation, 0.1, 0.01);
  EXPECT_LT(std::abs(fit.values(0) - 3.0), 3.0 * textbook);
  EXPECT_TRUE(fit.estimate(0).determined());
}

TEST(LeastSquares, ConditionIsOneForOrthogonalColumnsOfAnyLength) {
  MatrixXd basis(4, 2);
  basis << 1, 1e6, 1, -1e6, 1, 1e6, 1, -1e6;
  EXPECT_NEAR(fit_linear(basis, VectorXd::Ones(4)).condition, 1.0, 1e-12);
}

TEST(LeastSquares, ColumnsThatAreNearlyOneAreIllConditionedAndSaySo) {
  const VectorXd x = VectorXd::LinSpaced(50, 0.0, 1.0);
  MatrixXd basis(50, 2);
  basis << x, x + 1e-7 * x.array().square().matrix();
  const LinearFit fit = fit_linear(basis, x);
  EXPECT_GT(fit.condition, largest_condition);
  EXPECT_FALSE(fit.estimate(0).determined());
  EXPECT_NE(fit.estimate(0).why_not.find("ill-conditioned"), std::string::npos);
}

TEST(LeastSquares, AValueWithinItsErrorsOfZeroIsNotDetermined) {
  const VectorXd x = VectorXd::LinSpaced(400, 0.0, 1.0);
  const LinearFit fit = fit_polynomial(x, VectorXd::Constant(400, 5.0) + noise(400, 0.1), 1);
  EXPECT_FALSE(fit.estimate(0).determined());
  EXPECT_TRUE(fit.estimate(1).determined());
}

TEST(LeastSquares, AsManyCoefficientsAsDataHaveNoErrorToJudgeBy) {
  const LinearFit fit = fit_polynomial(VectorXd::LinSpaced(3, 1.0, 3.0), VectorXd::LinSpaced(3, 2.0, 8.0), 2);
  EXPECT_TRUE(std::isinf(fit.estimate(0).standard_error));
  EXPECT_FALSE(fit.estimate(0).determined());
}

Separable exponential(const VectorXd& x) {
  Separable model;
  model.basis = [&x](double p) {
    MatrixXd basis(x.size(), 2);
    basis << VectorXd::Ones(x.size()), (p * x).array().exp().matrix();
    return basis;
  };
  model.slope = [&x](double p) {
    MatrixXd slope = MatrixXd::Zero(x.size(), 2);
    slope.col(1) = x.array() * (p * x).array().exp();
    return slope;
  };
  model.lowest = 1.0;
  model.highest = 200.0;
  return model;
}

TEST(VariableProjection, FindsAPlantedExponent) {
  const VectorXd x = VectorXd::LinSpaced(300, 0.0, 0.25);
  for (const double planted : {3.0, 17.5, 60.0}) {
    const VectorXd y = VectorXd::Constant(300, 4.0) + 0.5 * (planted * x).array().exp().matrix();
    const ProjectedFit fit = fit_separable(exponential(x), y);
    EXPECT_NEAR(fit.parameter, planted, 1e-4 * planted);
    EXPECT_NEAR(fit.linear.values(1), 0.5, 1e-3);
    EXPECT_FALSE(fit.at_bound);
  }
}

TEST(VariableProjection, ErrorsCoverTheExponentToo) {
  const VectorXd x = VectorXd::LinSpaced(300, 0.0, 0.25);
  const VectorXd clean = VectorXd::Constant(300, 4.0) + 0.5 * (17.5 * x).array().exp().matrix();
  const ProjectedFit fit = fit_separable(exponential(x), clean + noise(300, 0.5));
  MatrixXd with_known_exponent = exponential(x).basis(fit.parameter);
  EXPECT_GT(fit.linear.standard_errors(1),
            2.0 * fit_linear(with_known_exponent, clean + noise(300, 0.5)).standard_errors(1));
  EXPECT_LT(std::abs(fit.parameter - 17.5), 3.0 * fit.parameter_error);
}

TEST(VariableProjection, AnExponentOutsideTheRangeIsNotDetermined) {
  const VectorXd x = VectorXd::LinSpaced(300, 0.0, 0.25);
  const ProjectedFit fit = fit_separable(exponential(x), (400.0 * x).array().exp().matrix());
  EXPECT_TRUE(fit.at_bound);
  EXPECT_FALSE(fit.parameter_estimate().determined());
}

}  // namespace
}  // namespace mckibben::thesis
