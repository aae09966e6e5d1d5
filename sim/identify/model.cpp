// See the header.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <sim/identify/decisive.hpp>
#include <sim/identify/model.hpp>

namespace mckibben::identify {

using Eigen::Index;

double log_t(double z) {
  const double nu = decisive.tails;
  return std::lgamma(0.5 * (nu + 1.0)) - std::lgamma(0.5 * nu) - 0.5 * std::log(nu * std::numbers::pi) -
         0.5 * (nu + 1.0) * std::log1p(z * z / nu);
}

double log_normal_cdf(double z) {
  if (z > -8.0) return std::log(0.5 * std::erfc(-z / std::numbers::sqrt2));
  return -0.5 * z * z - std::log(-z) - 0.5 * std::log(2.0 * std::numbers::pi) + std::log1p(-1.0 / (z * z));
}

Model::Model(const Problem& p, Point at, const Error& e, double scale_N)
    : problem(&p), point(std::move(at)), error(e.with(point.differ)), term_N(scale_N) {}

Eigen::VectorXd Model::residual() const {
  Eigen::VectorXd left = problem->rows.read - read;
  // The prior of numbers of runs is round nothing: what they did where they are simulated is given back.
  for (const Block& block : problem->rows.blocks) {
    auto part = left.segment(block.begin, block.rows);
    for (const int which : point.differ)
      if (const auto& values = point.of_runs[static_cast<std::size_t>(which)]; !values.empty())
        part += values[block.run] * error.per_unit(which, block);
    if (!point.starts.empty()) part += error.started(block, point.starts[block.run]);
  }
  return left;
}

bool Model::has_effects() const {
  return std::ranges::any_of(point.effects, [&](const Added& added) {
    return problem->dictionary.entries[added.entry].effect.has_value();
  });
}

std::vector<std::size_t> Model::may_be_nothing() const {
  std::vector<std::size_t> places;
  const auto coordinates = problem->dictionary.coordinates(point);
  const Eigen::VectorXd v = problem->dictionary.vector(point);
  for (Index j = 0; j < std::min(v.size(), covariance.rows()); ++j)
    if (const auto& [kind, of, which] = coordinates[static_cast<std::size_t>(j)];
        kind == Kind::size && std::abs(v[j]) <= decisive.errors * std::sqrt(covariance(j, j)))
      places.push_back(of);
  return places;
}

double Model::left() const {
  return problem->rows.rms(residual()) / problem->rows.unit;
}

namespace {

double log_prior_of(const Dictionary& dictionary, const Point& point, double term_N) {
  const double half_log = 0.5 * std::log(2.0 * std::numbers::pi);
  const Eigen::VectorXd v = dictionary.vector(point);
  double value = 0.0;
  Index j = 0;
  for (const Coordinate& one : dictionary.coordinates(point)) {
    const double z = v[j++];
    if (one.kind == Kind::term) {
      value -= 0.5 * (z / term_N) * (z / term_N) + half_log + std::log(term_N);
    } else if (one.kind == Kind::parameter) {
      value += log_t(z);
    } else if (one.kind == Kind::size) {
      value += log_t(z);
      if (!dictionary.entries[point.effects[one.of].entry].either_sign) value += std::numbers::ln2;
    } else {
      value -= 0.5 * z * z + half_log;
    }
  }
  return value;
}

}  // namespace

double Model::log_prior() const {
  return log_prior_of(problem->dictionary, point, term_N);
}

Eigen::VectorXd Model::variance() const {
  Eigen::VectorXd list = problem->dictionary.vector(point);
  Index j = 0;
  for (const Coordinate& one : problem->dictionary.coordinates(point)) {
    double& value = list[j++];
    if (one.kind == Kind::term)
      value = term_N * term_N;
    else
      value = one.kind == Kind::parameter || one.kind == Kind::size
                  ? (decisive.tails + value * value) / (decisive.tails + 1.0)
                  : 1.0;
  }
  return list;
}

void Model::look_at_wander() {
  error.take(problem->simulator.wander(problem->dictionary.setting(point)));
}

void Model::look() {
  const Dictionary& dictionary = problem->dictionary;
  const Eigen::VectorXd v = dictionary.vector(point);
  const Index k = v.size();
  constexpr double first = 0.1;
  const Eigen::MatrixXd axes = open_.cols() == k ? open_ : first * Eigen::MatrixXd::Identity(k, k);
  std::vector<Setting> settings{dictionary.setting(point)};
  Eigen::MatrixXd moved(k, k);
  for (Index i = 0; i < k; ++i) {
    Point there = dictionary.moved(point, v + axes.col(i));
    moved.col(i) = dictionary.vector(there) - v;
    if (moved.col(i) != axes.col(i)) {  // over the edge of a range
      const Point other = dictionary.moved(point, v - axes.col(i));
      if (const Eigen::VectorXd by = dictionary.vector(other) - v; by.norm() > moved.col(i).norm()) {
        moved.col(i) = by;
        there = other;
      }
    }
    settings.push_back(dictionary.setting(there));
  }
  const Eigen::MatrixXd seen = problem->simulator.differences(settings);
  if (read.size() == 0) read = seen.col(0);  // else they stay: changes are known better than where they begin
  if (slopes.cols() != k) slopes = Eigen::MatrixXd::Zero(seen.rows(), k);
  std::vector<Index> good;
  for (Index i = 0; i < k; ++i)
    if (seen.col(i + 1).allFinite() && !moved.col(i).isZero(0.0)) good.push_back(i);
  if (good.empty()) return;
  const Eigen::MatrixXd by = moved(Eigen::all, good);
  const Eigen::VectorXd scale = by.colwise().norm().cwiseInverse();  // a short axis is not nothing
  slopes += (seen.rightCols(k)(Eigen::all, good) - slopes * by) * scale.asDiagonal() *
            (by * scale.asDiagonal()).completeOrthogonalDecomposition().pseudoInverse();
}

Model::Here Model::here() const {
  const Eigen::VectorXd left = residual(), of_prior = variance();
  const Error begun = error.begun();
  const auto laplace = [&](const Error& one, bool stepped) {
    const Grams at = one.grams(left, slopes);
    const Eigen::MatrixXd gram = at.sum();
    const Eigen::LLT<Eigen::MatrixXd> low(curvature(gram, of_prior.cwiseInverse()));
    return log_prior() +
           0.5 * static_cast<double>(slopes.cols() - left.size()) * std::log(2.0 * std::numbers::pi) -
           0.5 * (at.log_det() + gram(0, 0)) - low.matrixLLT().diagonal().array().log().sum() +
           (stepped ? quadratic(gram).promised() : 0.0);
  };
  const Error as_it_stands = begun.fitted_anew(left, Eigen::MatrixXd(left.size(), 0), Eigen::VectorXd());
  const Error after_a_step = begun.fitted_anew(left, slopes, of_prior);
  const double stands = laplace(as_it_stands, false);
  return {stands, std::max(stands, laplace(after_a_step, true)), after_a_step.explains()};
}

void Model::fit_error(std::vector<double> steps, std::vector<std::size_t> only) {
  error = error.fitted(residual(), slopes, variance(), std::move(steps), std::move(only)).first;
}

double Model::cost(const Eigen::VectorXd& would_read, const Point& at) const {
  if (!would_read.allFinite()) return std::numeric_limits<double>::infinity();
  const Eigen::VectorXd left = residual() + read - would_read;
  const Grams grams_there = error.grams(left, Eigen::MatrixXd(left.size(), 0));
  return 0.5 * grams_there.sum()(0, 0) - log_prior_of(problem->dictionary, at, term_N);
}

Quadratic Model::quadratic(const Eigen::MatrixXd& gram) const {
  const Dictionary& dictionary = problem->dictionary;
  return {gram, variance().cwiseInverse(), dictionary.vector(point), dictionary.ends(point)};
}

double Model::evidence() {
  if (!read.allFinite()) return score = log_evidence = -std::numeric_limits<double>::infinity();
  if (!point.has_lines()) {
    if (const Eigen::VectorXd finely = problem->simulator.read(problem->dictionary.setting(point));
        finely.allFinite())
      read = finely;
    look_at_wander();
  }
  const Eigen::VectorXd prior_variance = variance(), left = residual();
  error = error.fitted_anew(left, slopes, prior_variance);
  fit_error({0.25});
  grams = error.grams(left, slopes);
  const Eigen::MatrixXd gram = grams.sum();
  const Eigen::VectorXd v = problem->dictionary.vector(point), weight = prior_variance.cwiseInverse();
  const Index k = v.size();
  const Eigen::LLT<Eigen::MatrixXd> low(curvature(gram, weight));
  covariance = low.solve(Eigen::MatrixXd::Identity(k, k));
  double value = log_prior() + error.log_scales() -
                 0.5 * (static_cast<double>(read.size()) * std::log(2.0 * std::numbers::pi) +
                        grams.log_det() + gram(0, 0)) +
                 (k > 0 ? quadratic(gram).promised() : 0.0) +
                 0.5 * static_cast<double>(k) * std::log(2.0 * std::numbers::pi);
  if (k > 0) value -= low.matrixLLT().diagonal().array().log().sum();
  Index j = 0;
  for (const Coordinate& coordinate : problem->dictionary.coordinates(point)) {
    if (coordinate.kind == Kind::size &&
        !problem->dictionary.entries[point.effects[coordinate.of].entry].either_sign)
      value += log_normal_cdf((v[j] - decisive.least) / std::sqrt(covariance(j, j)));
    ++j;
  }
  return log_evidence = value;
}

Model Model::with_terms(Terms terms, const Eigen::MatrixXd& columns, double scale_N) const {
  Model m(*problem, point, error, scale_N);
  m.point.terms = terms;
  m.point.coefficients = Eigen::VectorXd::Zero(columns.cols());
  m.read = read;
  m.slopes.resize(slopes.rows(), slopes.cols() + columns.cols());
  m.slopes << slopes, columns;
  m.fit_error({1.0, 0.5});
  m.evidence();
  return m;
}

}  // namespace mckibben::identify
