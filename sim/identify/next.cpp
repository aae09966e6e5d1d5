// See the header.
#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include <sim/diagnose/plan.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/engine/batch.hpp>
#include <sim/identify/decisive.hpp>
#include <sim/identify/next.hpp>
#include <sim/identify/quadratic.hpp>

namespace mckibben::identify {

using Eigen::Index;

namespace {

/// What a model reads in a run, and how that changes with its numbers.
struct Foreseen {
  Eigen::VectorXd read;
  Eigen::MatrixXd columns;
};

Foreseen foreseen(const Model& model, const domain::Run& run) {
  const Dictionary& dictionary = model.problem->dictionary;
  const Eigen::VectorXd v = dictionary.vector(model.point);
  std::vector<diagnose::Loaded> rigs;
  std::vector<double> steps;
  for (Index j = 0; j < v.size(); ++j) {
    Eigen::VectorXd there = v;
    there[j] += std::clamp(std::sqrt(model.covariance(j, j)), 0.01, 0.1);
    const Point moved = dictionary.moved(model.point, there);
    steps.push_back(dictionary.vector(moved)[j] - v[j]);
    rigs.push_back({dictionary.setting(moved).rig, run.load_kg});
  }
  const diagnose::Loaded base{dictionary.setting(model.point).rig, run.load_kg};
  constexpr std::size_t width = engine::Batch::width - 1;
  Foreseen result;
  for (std::size_t first = 0; first == 0 || first < rigs.size(); first += width) {
    std::vector<diagnose::Loaded> group{base};
    const std::size_t last = std::min(first + width, rigs.size());
    for (std::size_t i = first; i < last; ++i) group.push_back(rigs[i]);
    const auto readings = diagnose::predict(run, group, model.problem->rows.data().rig.integrator.method);
    const auto of = [&](std::size_t i) {
      return Eigen::Map<const Eigen::VectorXd>(readings[i].judged.data(), std::ssize(readings[i].judged));
    };
    if (first == 0) {
      result.read = of(0);
      result.columns = Eigen::MatrixXd::Zero(result.read.size(), v.size());
    }
    for (std::size_t i = first; i < last; ++i)
      if (steps[i] != 0.0) result.columns.col(static_cast<Index>(i)) = (of(i - first + 1) - of(0)) / steps[i];
  }
  return result;
}

/// Variance of the mean of many rows, a row: noise and what the model errs by for long.
double long_variance(const Model& model) {
  const double white = model.error.white(), of_model = model.error.of_model();
  return white * white + 2.0 * of_model * of_model * model.error.length_s() / model.problem->rows.row_s;
}

/// Probability that a model becomes less probable by so much where a run reads `truth`.
double power(const Model& model, const Foreseen& by, const Eigen::VectorXd& truth) {
  const double variance = long_variance(model);
  const Eigen::VectorXd off = truth - by.read;
  double square = off.squaredNorm();
  if (by.columns.cols() > 0) {
    const Eigen::MatrixXd known = variance * curvature(model.grams.sum(), model.variance().cwiseInverse()) +
                                  by.columns.transpose() * by.columns;
    const Eigen::VectorXd along = by.columns.transpose() * off;
    square -= along.dot(known.llt().solve(along));
  }
  const double growth = std::max(square / variance, 0.0);
  return growth > 0.0 ? 0.5 * std::erfc((decisive.strong - 0.5 * growth) / std::sqrt(2.0 * growth)) : 0.0;
}

}  // namespace

std::optional<diagnose::NextExperiment> next_measurement(const Model& one, const Model& other,
                                                         std::vector<std::string> names, unsigned threads) {
  const auto rig_of = [](const Model& model) { return model.problem->dictionary.setting(model.point).rig; };
  return diagnose::plan(one.problem->rows.data(), threads, rig_of(one), rig_of(other), std::move(names),
                        [&](const domain::Run& run) {
                          const Foreseen by_one = foreseen(one, run), by_other = foreseen(other, run);
                          return std::min(power(other, by_other, by_one.read),
                                          power(one, by_one, by_other.read));
                        });
}

}  // namespace mckibben::identify
