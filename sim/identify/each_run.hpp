// Values of one kind of bench fault in each run of a model: what they are, how well they are known, and what
// runs have in common.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <sim/identify/model.hpp>

namespace mckibben::identify {

/// Values of one kind of fault in the runs of a model, and their covariance.
struct EachRun {
  std::vector<double> values{};
  Eigen::MatrixXd covariance{};

  double deviation(const Eigen::VectorXd& of) const;
  std::vector<double> deviations() const;
};

/// Of the kind at a place of the point's `differ`: its most probable values, and with their covariance.
std::vector<double> values_of(const Model& model, std::size_t place);
EachRun each_run(const Model& model, std::size_t place);

/// What runs have in common of one kind of fault, which the rig's parameters can imitate: the median, or one
/// in proportion to something.
struct Common {
  Eigen::VectorXd sizes;    ///< to what it is in proportion, of each run
  Eigen::VectorXd weights;  ///< of the runs' values in it, a unit of that
  double value = 0.0;

  Common(const std::vector<double>& values, Eigen::VectorXd of);
  /// Of one run what is its own, as a sum of all values.
  Eigen::VectorXd own(Eigen::Index run) const;
  std::vector<double> owns(const std::vector<double>& values) const;
  /// How far the values are from it, most of them.
  double spread(const std::vector<double>& values) const;
};

/// Whether what differs is off in few runs: lengths that are off in most are a law of lengths that is, no
/// wrong labels.
bool most_are_right(const Grams& grams, const Point& point, int which);

}  // namespace mckibben::identify
