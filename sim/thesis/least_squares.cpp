// See the header. The orthogonal factor is never kept: only the triangle matters for errors and condition.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <fmt/format.h>

#include <sim/data/golden_section.hpp>
#include <sim/thesis/least_squares.hpp>

namespace mckibben::thesis {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

/// Sum of squared residuals only.
double misfit(const MatrixXd& basis, const VectorXd& data) {
  const VectorXd length = basis.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
  const MatrixXd scaled = basis * length.cwiseInverse().asDiagonal();
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(scaled);
  const VectorXd turned = qr.householderQ().adjoint() * data;
  return turned.tail(data.size() - qr.rank()).squaredNorm();
}

void add_errors(LinearFit& fit, const Geometry& shape, Index parameters) {
  const Index spare = fit.residuals.size() - parameters;
  fit.condition = shape.condition;
  const double infinite = std::numeric_limits<double>::infinity();
  fit.standard_deviation =
      spare > 0 ? fit.residuals.norm() / std::sqrt(static_cast<double>(spare)) : infinite;
  if (spare > 0)
    fit.covariance = fit.standard_deviation * fit.standard_deviation * shape.inverse;
  else
    fit.covariance = MatrixXd::Constant(shape.inverse.rows(), shape.inverse.cols(), infinite);
}

}  // namespace

Geometry geometry(const MatrixXd& basis) {
  // A direction whose singular value is nil counts as infinitely uncertain.
  const VectorXd length = basis.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
  const MatrixXd scaled = basis * length.cwiseInverse().asDiagonal();
  const Index n = basis.cols();
  const Eigen::HouseholderQR<MatrixXd> qr(scaled);
  const MatrixXd triangle = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<MatrixXd> svd(triangle, Eigen::ComputeFullV);
  const VectorXd s = svd.singularValues().cwiseMax(1e-150);
  const MatrixXd half = length.cwiseInverse().asDiagonal() * svd.matrixV() * s.cwiseInverse().asDiagonal();
  return {half * half.transpose(), s(0) / s(n - 1)};
}

void judge(Estimate& estimate) {
  if (estimate.condition > largest_condition)
    estimate.why_not = fmt::format("ill-conditioned ({:.1e})", estimate.condition);
  else if (!std::isfinite(estimate.standard_error))
    estimate.why_not = "no more data than coefficients";
  else if (std::abs(estimate.value) < 2.0 * estimate.standard_error)
    estimate.why_not = "not significant";
}

Estimate LinearFit::estimate(Index i) const {
  Estimate estimate{values(i), standard_errors(i), condition, {}};
  judge(estimate);
  return estimate;
}

LinearFit fit_linear(const MatrixXd& basis, const VectorXd& data) {
  LinearFit fit;
  const VectorXd length = basis.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
  const MatrixXd scaled = basis * length.cwiseInverse().asDiagonal();
  fit.values = length.cwiseInverse().asDiagonal() * scaled.colPivHouseholderQr().solve(data);
  fit.residuals = data - basis * fit.values;
  add_errors(fit, geometry(basis), basis.cols());
  fit.standard_errors = fit.covariance.diagonal().cwiseSqrt();
  return fit;
}

LinearFit fit_polynomial(const VectorXd& x, const VectorXd& y, int order) {
  MatrixXd basis(x.size(), order + 1);
  for (int power = 0; power <= order; ++power) basis.col(order - power) = x.array().pow(power);
  return fit_linear(basis, y);
}

double polynomial(const VectorXd& coefficients, double x) {
  double value = 0.0;
  for (const double each : coefficients) value = value * x + each;
  return value;
}

Estimate ProjectedFit::estimate(Index i) const {
  Estimate estimate = linear.estimate(i);
  if (at_bound) estimate.why_not = "exponent at the end of its range";
  return estimate;
}

Estimate ProjectedFit::parameter_estimate() const {
  Estimate estimate{parameter, parameter_error, linear.condition, {}};
  judge(estimate);
  if (at_bound) estimate.why_not = "exponent at the end of its range";
  return estimate;
}

ProjectedFit fit_separable(const Separable& model, const VectorXd& data) {
  constexpr int scanned = 40;
  const double low = std::log(model.lowest), high = std::log(model.highest);
  const double step = (high - low) / scanned;
  const auto cost = [&](double logarithm) { return misfit(model.basis(std::exp(logarithm)), data); };

  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= scanned; ++i)
    if (const double value = cost(low + i * step); value < least) {
      least = value;
      best = i;
    }

  ProjectedFit fit;
  fit.parameter = std::exp(data::golden_section(cost, std::max(low, low + (best - 1) * step),
                                                std::min(high, low + (best + 1) * step), 1e-7));
  fit.at_bound = fit.parameter < model.lowest * 1.001 || fit.parameter > model.highest / 1.001;
  const MatrixXd basis = model.basis(fit.parameter);
  fit.linear = fit_linear(basis, data);
  MatrixXd all(basis.rows(), basis.cols() + 1);
  all << basis, model.slope(fit.parameter) * fit.linear.values;
  add_errors(fit.linear, geometry(all), all.cols());
  const VectorXd errors = fit.linear.covariance.diagonal().cwiseSqrt();
  fit.linear.standard_errors = errors.head(basis.cols());
  fit.parameter_error = errors(basis.cols());
  return fit;
}

}  // namespace mckibben::thesis
