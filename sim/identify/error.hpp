// The objective: how probable rows are.
//
//   reading = h(parameters, effects, bench) + D w + c_b b + g d + q + e          of run r, row i
//   log p(rows) = -1/2 (n log 2 pi + log|Sigma| + r' Sigma^-1 r) + log prior + k/2 log 2 pi - 1/2 log|H|
//
//   D w   wander of the input, through the simulator: a Gaussian process at knots, correlation
//         exp(-s / 2 s), integrated out      b   what differs from run to run, normal, integrated out
//   d     model error of the run, an Ornstein-Uhlenbeck process; reaches the reading by the rig's compliance,
//         g = hypot(|dh/d input| over its rms, constant)
//   q     counting, q^2/12; of it stays from row to row what the load has not moved past (Widrow & Kollar
//   2008) e     white noise            r  what is left;   H = X' Sigma^-1 X + curvature of the prior: Laplace
// d and q are first-order each: a filter of two states whitens a column in O(rows) (whiten.hpp). The numbers
// of the error itself are fitted by restricted likelihood: columns of the model have had their say.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <sim/identify/simulator.hpp>
#include <sim/identify/whiten.hpp>

namespace mckibben::identify {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Of each run X' Sigma^-1 X, of columns of which the first is the residual; and log|Sigma|.
struct Grams {
  std::vector<Eigen::MatrixXd> of_runs;
  std::vector<double> log_dets;
  /// What differs from run to run, then numbers of its start, by the first column: mean and deviation,
  /// [run][which].
  std::vector<Eigen::VectorXd> means, deviations;

  Eigen::MatrixXd sum() const;
  double log_det() const;
};

class Error {
 public:
  Error(const Rows& rows, const Wander& wander, unsigned threads = 1);

  /// With another wander, after the setting has moved.
  void take(const Wander& wander);
  /// With these differing from run to run; scales that were known stay.
  Error with(const std::vector<int>& differ) const;

  Grams grams(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns) const;

  /// The error whose numbers make the rows most probable after the columns, whose priors have these
  /// variances, have had their say; and the log evidence then.
  std::pair<Error, double> fitted(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns,
                                  const Eigen::VectorXd& variance, std::vector<double> steps,
                                  std::vector<std::size_t> only = {}) const;

  /// The same from here, from the numbers that it began with, and from all white: there are several optima.
  Error fitted_anew(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns,
                    const Eigen::VectorXd& variance) const;

  /// One that forgets at once: all that is slow must be met.
  Error forgetting() const;
  /// With the numbers that it began with.
  Error begun() const;
  /// Of what differs: log density of its scales, with Laplace's share.
  double log_scales() const;

  double white() const;     ///< deviation of the judged reading's noise, counts included
  double of_model() const;  ///< of the model error, as it reaches the judged reading
  double length_s() const;
  double wander_units() const;
  /// The model errs less than readings do.
  bool explains() const { return of_model() < white(); }
  /// What one unit of what may differ does to a block's rows.
  Eigen::VectorXd per_unit(int which, const Block& block) const {
    return random_->col(which).segment(block.begin, block.rows);
  }
  std::size_t starts() const { return starts_; }
  /// What a run's start does to a block's rows.
  Eigen::VectorXd started(const Block& block, const Eigen::VectorXd& start) const;
  std::size_t scale_of_differing(std::size_t place) const { return base() + place; }
  /// Of what differs, at a place of the point's list.
  double scale(std::size_t place) const { return std::exp(logs_[base() + place]); }
  static constexpr std::size_t model_sd = 1;

 private:
  /// What a block whitened depends on.
  std::vector<double> key(std::size_t block) const;
  Whitened whitened(const Block& block, const RowMajor& columns) const;
  /// Those that have not been, side by side.
  void whiten(const RowMajor& columns, const std::vector<Whitened*>& blocks) const;
  Grams integrated(const std::vector<Whitened*>& blocks, Eigen::Index columns) const;
  RowMajor rows_of(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns) const;
  double log_prior() const;
  bool allowed() const;
  std::size_t wander_at() const { return 3 + 2 * (rows_->kinds.size() - 1); }
  std::size_t constant_at() const { return wander_at() + 1; }
  std::size_t base() const { return wander_at() + 2; }
  double gain(Eigen::Index row) const;

  const Rows* rows_;
  unsigned threads_;
  std::vector<double> logs_, start_;  ///< jitter, model error, its length; noise and error of each other
                                      ///< kind; wander, constant part of the gain; scales of what differs
  std::vector<int> differ_;
  // Of a wander, shared by all errors beside one setting.
  std::shared_ptr<const RowMajor> random_;  ///< columns of what differs, then of the wander
  std::shared_ptr<const std::vector<Eigen::MatrixXd>> roots_;  ///< [run] of the wander's correlation
  std::size_t starts_ = 0;  ///< columns of a run's start, after its wander's
  std::shared_ptr<const Eigen::VectorXd> compliance_;
};

/// Log evidence of a linear model with independent normal priors; the Gram matrix's first row and column are
/// the residual's.
double log_evidence(const Eigen::MatrixXd& gram, double log_det, Eigen::Index rows,
                    const Eigen::VectorXd& variance);

}  // namespace mckibben::identify
