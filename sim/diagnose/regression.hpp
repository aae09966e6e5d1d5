// Linear least squares that grows by a column at a time: what one more column would explain of what the
// others leave (Frisch & Waugh, Econometrica 1 (1933) 387-401).
#pragma once

#include <Eigen/Core>

#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {

class Regression {
 public:
  explicit Regression(Eigen::VectorXd values) : left_(std::move(values)) {}

  /// Adds a column. One that the others imitate to rounding changes nothing.
  void add(Eigen::VectorXd column) {
    const double before = column.squaredNorm();
    for (int twice = 0; twice < 2; ++twice) column -= basis_ * (basis_.transpose() * column);
    if (column.squaredNorm() <= thresholds.fault.rounding * before) return;
    column.normalize();
    left_ -= column * column.dot(left_);
    basis_.conservativeResize(left_.size(), basis_.cols() + 1);
    basis_.rightCols(1) = column;
  }

  struct Gain {
    double drop = 0.0;       ///< of the sum of squares
    double amplitude = 0.0;  ///< of the column, with all others fitted beside it
  };
  /// Of one more column, which is `part` from row `begin` on and 0 elsewhere.
  Gain gain(const Eigen::VectorXd& part, Eigen::Index begin) const {
    const Eigen::VectorXd along = basis_.middleRows(begin, part.size()).transpose() * part;
    const double own = part.squaredNorm() - along.squaredNorm();
    if (own <= thresholds.fault.rounding * part.squaredNorm()) return {};
    const double product = part.dot(left_.segment(begin, part.size()));
    return {product * product / own, product / own};
  }

  const Eigen::VectorXd& left() const { return left_; }
  double cost() const { return left_.squaredNorm(); }

 private:
  Eigen::VectorXd left_;
  Eigen::MatrixXd basis_{left_.size(), 0};
};

}  // namespace mckibben::diagnose
