// Least squares as all of the thesis's curves need it: columns scaled to length one, solved by QR, with
// standard errors and a condition number; and variable projection (Golub and Pereyra, SIAM J. Numer. Anal. 10
// (1973) 413-432) for models that are linear but for one parameter, so that only that one is searched.
#pragma once

#include <functional>
#include <string>

#include <Eigen/Core>

namespace mckibben::thesis {

/// One fitted number. `why_not` says why the data do not determine it; empty if they do.
struct Estimate {
  double value = 0.0;
  double standard_error = 0.0;  ///< infinite if there were no more data than coefficients
  double condition = 0.0;       ///< of the scaled problem that gave it
  std::string why_not;

  bool determined() const { return why_not.empty(); }
};

/// Above this condition number of the scaled columns a misfit of one part in 100 000, far less than one count
/// of the encoder, may move a coefficient by its own size.
inline constexpr double largest_condition = 1e5;

/// Judges an estimate: condition above `largest_condition`, no spare data, or a value within two standard
/// errors of zero make it undetermined.
void judge(Estimate& estimate);

struct LinearFit {
  Eigen::VectorXd values, standard_errors;
  Eigen::VectorXd residuals;        ///< data less model
  double condition = 0.0;           ///< of the columns scaled to length one
  double standard_deviation = 0.0;  ///< of the residuals, with data less coefficients as divisor
  Eigen::MatrixXd covariance;       ///< of the values

  Estimate estimate(Eigen::Index i) const;
};

/// Fits `data` by the columns of `basis`. Needs at least as many rows as columns.
LinearFit fit_linear(const Eigen::MatrixXd& basis, const Eigen::VectorXd& data);

/// Coefficients of a polynomial, highest power first.
LinearFit fit_polynomial(const Eigen::VectorXd& x, const Eigen::VectorXd& y, int order);
double polynomial(const Eigen::VectorXd& coefficients, double x);

/// A model that is linear but for one parameter p: data = basis(p) times coefficients.
struct Separable {
  std::function<Eigen::MatrixXd(double)> basis;
  std::function<Eigen::MatrixXd(double)> slope;  ///< of the basis against p
  double lowest = 0.0, highest = 0.0;            ///< where p is searched, both above 0
};

struct ProjectedFit {
  double parameter = 0.0, parameter_error = 0.0;
  LinearFit linear;  ///< errors and condition are those of all parameters together
  bool at_bound = false;

  Estimate estimate(Eigen::Index i) const;
  Estimate parameter_estimate() const;
};

/// Inverse of basis' basis, and the condition number of the columns scaled to length one.
struct Geometry {
  Eigen::MatrixXd inverse;
  double condition = 0.0;
};
Geometry geometry(const Eigen::MatrixXd& basis);

/// The parameter with the least squares: a scan of the whole range in equal ratios, then golden section.
ProjectedFit fit_separable(const Separable& model, const Eigen::VectorXd& data);

}  // namespace mckibben::thesis
