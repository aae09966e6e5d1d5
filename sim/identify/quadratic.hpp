// The quadratic that a fit stands on, in the axes of its curvature, and the steps that it proposes.
#pragma once

#include <cmath>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace mckibben::identify {

/// Minus the second derivative of the log density, of a Gram matrix with the residual's row and column first
/// and the priors' precisions.
inline Eigen::MatrixXd curvature(const Eigen::MatrixXd& gram, const Eigen::VectorXd& weight) {
  Eigen::MatrixXd list = gram.bottomRightCorner(weight.size(), weight.size());
  list.diagonal() += weight;
  return list;
}

/// Of the log density in units of the priors: `gram` with the residual's row and column first.
struct Quadratic {
  static constexpr double shortest = 0.005, furthest = 0.3;  ///< of a difference, in deviations of the priors
  Eigen::VectorXd values, weight;
  Eigen::MatrixXd axes;
  Eigen::VectorXd pull;  ///< along the axes

  Quadratic(const Eigen::MatrixXd& gram, Eigen::VectorXd prior_weight, const Eigen::VectorXd& at)
      : weight(std::move(prior_weight)) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(curvature(gram, weight));
    values = solver.eigenvalues().cwiseMax(1e-12);
    axes = solver.eigenvectors();
    pull = axes.transpose() * (gram.col(0).tail(at.size()) - weight.cwiseProduct(at));
  }
  double promised() const { return 0.5 * pull.cwiseAbs2().cwiseQuotient(values).sum(); }
  double longest() const { return pull.cwiseQuotient(values).norm(); }
  /// The axes, each as long as the data leave it open.
  Eigen::MatrixXd open() const {
    return axes * values.cwiseSqrt().cwiseInverse().cwiseMax(shortest).cwiseMin(furthest).asDiagonal();
  }
  /// The step of a length, on Levenberg's path.
  Eigen::VectorXd step(double length) const {
    if (longest() <= length) return axes * pull.cwiseQuotient(values);
    const auto damped = [&](double log_more) {
      return Eigen::VectorXd(pull.cwiseQuotient((values.array() + std::exp(log_more)).matrix()));
    };
    double low = -20.0, high = 40.0;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (damped(middle).norm() > length ? low : high) = middle;
    }
    return axes * damped(high);
  }
};

}  // namespace mckibben::identify
