// Score tests; see the header. Slopes are one-sided, since some laws have a kink where they are absent, and
// taken twice: over a small step, and over a size that matters, because a muscle that swings answers a small
// change in another way than a large one.
#include <algorithm>
#include <cmath>

#include <sim/diagnose/screen.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

void sort(std::vector<Score>& scores) {
  std::stable_sort(scores.begin(), scores.end(),
                   [](const Score& a, const Score& b) { return a.drop > b.drop; });
}

}  // namespace

Projector::Projector(const Fitted& fitted, double inflation)
    : rows_(fitted.residuals.size()), weight_(1.0 / std::sqrt(inflation)) {
  const auto& free = fitted.model.free;
  std::vector<Eigen::Index> kept;
  for (std::size_t j = 0; j < free.size(); ++j) {
    const double value = value_of(fitted.model.rig, free[j].path);
    const double edge = thresholds.screen.at_bound * (free[j].highest - free[j].lowest);
    const bool inside = value > free[j].lowest + edge && value < free[j].highest - edge;
    if (inside) kept.push_back(static_cast<Eigen::Index>(j));
  }
  const auto count = static_cast<Eigen::Index>(kept.size());
  columns_.setZero(rows_ + count, count);
  for (Eigen::Index c = 0; c < count; ++c) {
    const auto j = kept[static_cast<std::size_t>(c)];
    columns_.col(c).head(rows_) = weight_ * fitted.columns.col(j);
    if (free[static_cast<std::size_t>(j)].has_prior) columns_(rows_ + c, c) = 1.0;
  }
  normal_.compute(columns_.transpose() * columns_ +
                  thresholds.screen.ridge * Eigen::MatrixXd::Identity(count, count));
}

Eigen::VectorXd Projector::operator()(const Eigen::VectorXd& values) const {
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(columns_.rows());
  whole.head(rows_) = weight_ * values;
  return whole - columns_ * normal_.solve(columns_.transpose() * whole);
}

std::vector<Score> screen(const Experiment& experiment, const Fitted& fitted,
                          const std::vector<Candidate>& candidates, const Runs& runs, double inflation) {
  struct Probe {
    std::size_t candidate;
    Candidate variation;
    double shape;
  };
  std::vector<Probe> probes;
  std::vector<Experiment::Change> changes;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& c = candidates[i];
    if (!c.fits(fitted.model.rig)) continue;
    const auto shapes = c.shapes.empty() ? std::vector{0.0} : c.shapes;
    for (const Candidate& variation : c.variations())
      for (const double shape : shapes)
        for (const double size : {c.step, thresholds.parameter.probe * c.typical}) {
          probes.push_back({i, variation, shape});
          changes.push_back({[variation, shape, size](Loaded& h) {
                               h.rig = variation.chosen(h.rig);
                               variation.put(h.rig, variation.absent + size, shape);
                             },
                             size, true});
        }
  }
  const auto slopes = experiment.slopes(fitted.model.rig, changes, runs);
  const Projector project(fitted, inflation);
  const Eigen::VectorXd residuals = project(fitted.residuals);
  std::vector<Score> scores(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) scores[i].candidate = candidates[i];
  for (std::size_t t = 0; t < probes.size(); ++t) {
    const Candidate& c = candidates[probes[t].candidate];
    Score& score = scores[probes[t].candidate];
    Eigen::VectorXd column = project(slopes.columns.col(static_cast<Eigen::Index>(t)));
    const double length = column.squaredNorm(), along = column.dot(residuals);
    if (!(length > 0.0)) continue;
    const double amplitude = along / length;
    const bool possible = c.either_sign || (amplitude > 0.0) == (c.typical > 0.0);
    const double drop = possible ? along * along / length : 0.0;
    if (score.column.size() > 0 && drop <= score.drop) continue;
    score.drop = drop;
    score.amplitude = c.absent + amplitude;
    score.candidate = probes[t].variation;
    score.shape = probes[t].shape;
    score.column = std::move(column);
  }
  sort(scores);
  return scores;
}

void join_sides(std::vector<Score>& scores, double finer) {
  for (Score& both : scores) {
    if (both.candidate.side != Side::both || !(both.drop > 0.0)) continue;
    for (Score& one : scores) {
      if (one.candidate.side == Side::both || one.candidate.effect != both.candidate.effect ||
          one.candidate.variant != both.candidate.variant || !(one.drop > 0.0))
        continue;
      const double alike = likeness(one, both), unlike = 1.0 - alike * alike;
      if (finer * std::max(one.drop, both.drop) * unlike > thresholds.near.clear) continue;
      both.same.push_back(one.candidate.side);
      one.drop = 0.0;
    }
  }
  sort(scores);
}

double likeness(const Score& a, const Score& b) {
  if (a.column.size() == 0 || b.column.size() == 0) return 0.0;
  // Scores of two screenings may differ in how many parameters were free: the readings come first.
  const Eigen::Index rows = std::min(a.column.size(), b.column.size());
  const auto x = a.column.head(rows), y = b.column.head(rows);
  return std::abs(x.dot(y)) / std::max(x.norm() * y.norm(), thresholds.screen.least_norm);
}

}  // namespace mckibben::diagnose
