// Tall columns in few rows: turned (QR), so that as many rows as there are columns have the same products of
// columns with one another, and least squares the same answer. Long recordings are regressed so, run by run.
#pragma once

#include <Eigen/QR>

namespace mckibben::diagnose {

/// `columns` as they are where they have no more rows than that.
inline Eigen::MatrixXd in_brief(Eigen::MatrixXd columns) {
  if (columns.rows() <= columns.cols()) return columns;
  const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> turned(columns);
  return columns.topRows(columns.cols()).triangularView<Eigen::Upper>();
}

}  // namespace mckibben::diagnose
