// See the header.
#include <algorithm>
#include <cmath>

#include <sim/thesis/friction.hpp>

namespace mckibben::thesis {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

constexpr double fewest_degrees = 0.2, most_degrees = 40.0;

/// ln of T 4.4.
Eigen::ArrayXd log_chi_square(const VectorXd& e, double v) {
  return (0.5 * v - 1.0) * e.array().log() - 0.5 * e.array() - 0.5 * v * std::log(2.0) - std::lgamma(0.5 * v);
}

MatrixXd powers(const VectorXd& e) {
  MatrixXd basis(e.size(), 6);
  for (int i = 0; i < 6; ++i) basis.col(i) = e.array().pow(i);
  return basis;
}

void fit_at_speed(FrictionAtSpeed& at) {
  const VectorXd e = vector(at.samples.contraction_ratio), f = vector(at.samples.coefficient);
  at.mean = f.mean();
  Separable model;
  model.basis = [&e](double v) { return MatrixXd(chi_square(e, v)); };
  model.slope = [&e](double v) {
    constexpr double step = 1e-4;
    const VectorXd slope = chi_square(e, v + step) - chi_square(e, v - step);
    return MatrixXd(slope / (2.0 * step));
  };
  model.lowest = fewest_degrees;
  model.highest = most_degrees;
  at.chi_square = fit_separable(model, f);
  at.fifth_order = fit_linear(powers(e), f);
  MatrixXd superposed(e.size(), 3);
  superposed << VectorXd::Ones(e.size()), e, e.array().log().matrix();
  at.superposition = fit_linear(superposed, f);
}

/// All speeds at once, each with an intercept of its own.
LinearFit fit_common(const std::vector<FrictionAtSpeed>& speeds) {
  const auto n = static_cast<Index>(speeds.size());
  Index rows = 0;
  for (const auto& at : speeds) rows += static_cast<Index>(at.samples.size());
  MatrixXd basis = MatrixXd::Zero(rows, n + 2);
  VectorXd data(rows);
  Index row = 0;
  for (Index s = 0; s < n; ++s) {
    const Samples& samples = speeds[static_cast<std::size_t>(s)].samples;
    const auto m = static_cast<Index>(samples.size());
    basis.block(row, s, m, 1).setOnes();
    basis.block(row, n, m, 1) = vector(samples.contraction_ratio);
    basis.block(row, n + 1, m, 1) = vector(samples.contraction_ratio).array().log().matrix();
    data.segment(row, m) = vector(samples.coefficient);
    row += m;
  }
  return fit_linear(basis, data);
}

/// A coefficient of the line through the intercepts. Their errors, which they share through f2 and f3, are in
/// it, and how far they are off the line.
Estimate on_line(const FrictionFit& fit, const VectorXd& squared_speed, Index which) {
  const Index n = squared_speed.size(), order = fit.linear.values.size() - 1;
  MatrixXd basis(n, order + 1);
  for (Index power = 0; power <= order; ++power)
    basis.col(order - power) = squared_speed.array().pow(static_cast<double>(power));
  const MatrixXd weights = geometry(basis).inverse * basis.transpose();
  const MatrixXd passed_on = weights * fit.common.covariance.topLeftCorner(n, n) * weights.transpose();
  Estimate estimate;
  estimate.value = fit.linear.values(which);
  const double off_line = n > order + 1 ? fit.linear.covariance(which, which) : 0.0;
  estimate.standard_error = std::sqrt(passed_on(which, which) + off_line);
  estimate.condition = std::max(fit.common.condition, fit.linear.condition);
  judge(estimate);
  return estimate;
}

}  // namespace

VectorXd chi_square(const VectorXd& contraction_ratio, double degrees_of_freedom) {
  return log_chi_square(contraction_ratio, degrees_of_freedom).exp();
}

VectorXd fifth_order(const VectorXd& contraction_ratio, const VectorXd& p) {
  return powers(contraction_ratio) * p;
}

controllers::FrictionModel FrictionFit::model() const {
  return {f0.value, f1.value, f2.value, f3.value};
}

FrictionFit fit_friction(const Grid& grid, Direction direction, int order) {
  FrictionFit fit;
  for (const double speed : grid.speeds_mA_per_s) {
    FrictionAtSpeed at;
    at.speed_mA_per_s = speed;
    for (const Cell& cell : grid.of(direction))
      if (cell.speed_mA_per_s == speed) at.samples.append(cell.samples);
    fit_at_speed(at);
    fit.speeds.push_back(std::move(at));
  }
  fit.common = fit_common(fit.speeds);
  const auto n = static_cast<Index>(fit.speeds.size());
  const VectorXd squared = vector(grid.speeds_mA_per_s).array().square();
  fit.linear = fit_polynomial(squared, fit.common.values.head(n), order);
  fit.f0 = on_line(fit, squared, order);
  if (order > 0)
    fit.f1 = on_line(fit, squared, 0);
  else
    fit.f1.why_not = "the order in speed is 0";
  fit.f2 = fit.common.estimate(n);
  fit.f3 = fit.common.estimate(n + 1);
  if (n >= 3) fit.quadratic = fit_polynomial(squared, fit.common.values.head(n), 2);

  const controllers::FrictionModel model = fit.model();
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (FrictionAtSpeed& at : fit.speeds) {
    const Eigen::ArrayXd e = vector(at.samples.contraction_ratio);
    const double nu = at.speed_mA_per_s;
    const VectorXd off = vector(at.samples.coefficient).array() -
                         (model.f0 + model.f1_s2_per_mA2 * nu * nu + model.f2 * e + model.f3 * e.log());
    const auto m = static_cast<double>(at.samples.size());
    at.common_deviation = std::sqrt(off.squaredNorm() / m);
    squares += off.squaredNorm();
    sum += at.mean * m;
    count += m;
  }
  fit.mean = sum / count;
  fit.standard_deviation = std::sqrt(squares / count);
  return fit;
}

}  // namespace mckibben::thesis
