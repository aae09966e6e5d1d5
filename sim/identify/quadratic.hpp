// The quadratic that a fit stands on, in the axes of its curvature, and the steps that it proposes. What is
// at an end of its range and would leave it is held there: the rest would bend to a step that is not made
// (Bertsekas, SIAM J. Control Optim. 20 (1982) 221-246).
#pragma once

#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <sim/identify/dictionary.hpp>

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

  Quadratic(const Eigen::MatrixXd& gram, Eigen::VectorXd prior_weight, const Eigen::VectorXd& at,
            const Ends& ends)
      : weight(std::move(prior_weight)) {
    Eigen::MatrixXd curved = curvature(gram, weight);
    Eigen::VectorXd slope = gram.col(0).tail(at.size()) - weight.cwiseProduct(at);
    hold(curved, slope, at, ends);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(curved);
    values = solver.eigenvalues().cwiseMax(1e-12);
    axes = solver.eigenvectors();
    pull = axes.transpose() * slope;
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

 private:
  /// First what the slope drives out, then what the step would.
  static void hold(Eigen::MatrixXd& curved, Eigen::VectorXd& slope, const Eigen::VectorXd& at,
                   const Ends& ends) {
    const auto hold_leaving = [&](const Eigen::VectorXd& way) {
      bool any = false;
      for (Eigen::Index i = 0; i < at.size(); ++i) {
        if (!((way[i] < 0.0 && at[i] <= ends.lowest[i]) || (way[i] > 0.0 && at[i] >= ends.highest[i])))
          continue;
        const double own = curved(i, i);
        curved.row(i).setZero();
        curved.col(i).setZero();
        curved(i, i) = own;
        slope[i] = 0.0;
        any = true;
      }
      return any;
    };
    hold_leaving(Eigen::VectorXd(slope));
    while (hold_leaving(curved.llt().solve(slope))) continue;
  }
};

}  // namespace mckibben::identify
