// Score tests: how much better would the model fit with each effect of the catalogue, and at what size? Only
// what the parameters that are free anyway cannot imitate counts (projection: Neyman's C(alpha), Rao's score;
// in structural equation models the modification index, Sorbom, Psychometrika 54 (1989) 371-384).
#pragma once

#include <vector>

#include <Eigen/Cholesky>

#include <sim/diagnose/candidate.hpp>
#include <sim/diagnose/fit.hpp>

namespace mckibben::diagnose {

/// Removes from a residual or a slope what the free parameters of a fit imitate, within their priors. A
/// parameter that stands at its bound is not free.
class Projector {
 public:
  Projector(const Fitted& fitted, double inflation);
  /// What is left of `values`, over the root of the inflation; then a row for each free parameter's prior.
  Eigen::VectorXd operator()(const Eigen::VectorXd& values) const;

 private:
  Eigen::Index rows_;
  double weight_;
  Eigen::MatrixXd columns_;
  Eigen::LDLT<Eigen::MatrixXd> normal_;
};

struct Score {
  Candidate candidate;
  double drop = 0.0;         ///< expected in the sum of squares / inflation
  double amplitude = 0.0;    ///< expected value of the amplitude parameter
  double shape = 0.0;        ///< of the shapes tried, the best
  Eigen::VectorXd column{};  ///< slope, less what the free parameters imitate; of the residuals' size
  std::vector<Side> same{};  ///< muscles of which one alone would change the same
};

/// The candidates, best first. Those already in the rig, and those with the wrong sign, score 0.
std::vector<Score> screen(const Experiment& experiment, const Fitted& fitted,
                          const std::vector<Candidate>& candidates, const Runs& runs, double inflation);

/// Of a pair: where what one muscle alone would do is, but for chance, what both do, both stand for it and it
/// scores 0. `finer`: by how much sums of squares count more once something fits.
void join_sides(std::vector<Score>& scores, double finer);

/// Cosine between what two effects change: at 1 these data cannot tell them apart.
double likeness(const Score& a, const Score& b);

}  // namespace mckibben::diagnose
