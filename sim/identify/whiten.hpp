// Rows whose errors depend on each other, as rows whose errors do not: a Kalman filter of two states, the
// model error and the part of counting that stays, carries every column along (see error.hpp). Most of a
// search's time beside its simulations goes here, so that columns are SIMD lanes; each sum is made in the
// order of the rows, so that results are the same bits on all machines.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

namespace mckibben::identify {

/// Errors of the rows of one reading of one run.
struct RowErrors {
  double white_square, model_square, counting_square;  ///< variances
  double alike;              ///< correlation of the model error of a row with that of the next
  std::vector<double> gain;  ///< [row] of the model error
  const char* known;         ///< [row] whether there is a reading
  const double* stays;       ///< [row] share of what counting adds that stays until the next
};

/// X' Sigma^-1 X and log|Sigma|.
struct Whitened {
  Eigen::MatrixXd gram;
  double log_det = 0.0;
};

/// `put` writes a row's columns.
Whitened whitened(const RowErrors& errors, Eigen::Index columns,
                  const std::function<void(Eigen::Index row, double* columns)>& put);

}  // namespace mckibben::identify
