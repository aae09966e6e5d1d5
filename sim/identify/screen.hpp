// Where a model stands: what each candidate would change, and which sets of them explain the rows, by one
// Gram matrix.
#pragma once

#include <vector>

#include <sim/identify/model.hpp>

namespace mckibben::identify {

/// A candidate of one size and one shape; its column is the change of readings for one unit of size.
struct Probe {
  std::size_t entry;
  double size;
  std::vector<double> shapes{};
};
std::vector<Probe> probes(const Dictionary& dictionary, const Point& beside);

/// Columns of these beside a model. Those that change nothing, or that no rig can have, go from the list.
Eigen::MatrixXd columns_of(const Model& model, std::vector<Probe>& probes);
/// The change by each term of a family, per newton.
Eigen::MatrixXd columns_of(const Model& model, Terms terms);

/// A set that may explain more: where its descent would begin, and its log evidence by straight lines.
struct Start {
  double value;
  Point point;
};

/// log prior of a set of so many names.
double log_prior_of_set(std::size_t size, std::size_t names);

/// A few members of a family of general terms.
struct Few {
  double value;  ///< as the score of the model with all of them
  double term_N;
  Point point;
  bool is_one() const { return point.members.size() == together(point.terms); }
};
/// The one member that explains most, and the best of several, each taken for what it adds to those before it
/// (forward selection), of a scale, by straight lines from a model with all of them.
std::vector<Few> few_of(const Model& all, double term_N);

/// Sets made of the base and probes. `far`: parameters stay where they are, else they give way.
std::vector<Start> sets(const Problem& problem, const Error& error, const Point& base, double term_N,
                        const Eigen::VectorXd& residual, const Eigen::MatrixXd& slopes,
                        const Eigen::MatrixXd& columns, const std::vector<Probe>& probes, bool far);

}  // namespace mckibben::identify
