// One hypothesis: a point, what it reads, and how that changes with each of its numbers. Its descent to the
// most probable numbers, and its evidence there.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <sim/identify/error.hpp>
#include <sim/identify/quadratic.hpp>

namespace mckibben::identify {

/// What stays the same throughout.
struct Problem {
  const Rows& rows;
  const Dictionary& dictionary;
  const Simulator& simulator;
  std::function<void(const std::string&)> say{};
};

class Model {
 public:
  Model(const Problem& problem, Point point, const Error& error, double term_N = 1.0);

  /// Readings and slopes at the point, by differences along the axes of the curvature, each as long as the
  /// data leave it open: in a curved valley large slopes of its numbers cancel, and the errors of differences
  /// along these would hide that.
  void look();
  void fit_error(std::vector<double> steps, std::vector<std::size_t> only = {});

  struct Effort {
    int rounds = 20;
    double enough = 0.5;  ///< nats that are promised: less is not worth a round
    double beat = -std::numeric_limits<double>::infinity();  ///< hopeless far below
  };
  /// Damped Gauss-Newton in units of the priors, with a trust region, to the most probable numbers.
  /// Stops where it has arrived, where there is no hope, or when the rounds are over.
  void descend(const Effort& effort);
  /// The same, numbers of runs placed.
  void settle(const Effort& effort);
  /// Laplace's at the point, what a last straight step would gain included. Sets all that follows from it.
  double evidence();
  /// The evidence by the slopes as they are, the error fitted afresh.
  struct Here {
    double evidence;
    double hoped;   ///< with what straight lines still promise
    bool explains;  ///< as Error's
  };
  Here here() const;
  /// The same with general terms, straight from here.
  Model with_terms(Terms terms, const Eigen::MatrixXd& columns, double term_N) const;

  Eigen::VectorXd residual() const;
  /// Root mean square of the judged reading's, in units of the rows.
  double left() const;
  /// Of the rig's numbers the one furthest from where it is described, in deviations.
  double off_sheet() const { return point.z.size() > 0 ? point.z.cwiseAbs().maxCoeff() : 0.0; }
  /// Effects of the rig, not only faults of the bench.
  bool has_effects() const;
  /// Places of the effects whose size is within its interval of nothing.
  std::vector<std::size_t> may_be_nothing() const;
  /// Variances of the priors, of the normals that touch them.
  Eigen::VectorXd variance() const;
  double log_prior() const;

  const Problem* problem;
  Point point;
  Error error;
  double term_N;
  Eigen::VectorXd read;
  Eigen::MatrixXd slopes;

  bool far = true;        ///< descends by an error that forgets at once, until that promises nothing
  bool arrived = false;   ///< at the most probable numbers
  bool hopeless = false;  ///< it would not have come near what it was to beat
  // of evidence()
  Grams grams;
  Eigen::MatrixXd covariance;
  double log_evidence = 0.0;
  // of the table
  double score = 0.0;
  Eigen::VectorXd held_out{};  ///< log density of each group of runs given the others

 private:
  double cost(const Eigen::VectorXd& would_read, const Point& at) const;
  /// As the error sees it.
  Quadratic quadratic(const Eigen::MatrixXd& gram) const;
  /// Simulates numbers of runs, which are not straight, where they are most probable; whether any has moved.
  bool place();
  /// What the loads of all runs have in common is the rig's offset as well: the readings are the same, and
  /// the priors say whose it is.
  void share_common_load();
  void look_at_wander();

  Eigen::MatrixXd open_{};  ///< axes of the curvature, as long as the data leave them open, where known
};

/// log density of Student's t of a size.
double log_t(double z);
/// log of the normal distribution function.
double log_normal_cdf(double z);

}  // namespace mckibben::identify
