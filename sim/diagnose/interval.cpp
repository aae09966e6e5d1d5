// Intervals; see the header.
#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Cholesky>

#include <plant/instruments.hpp>
#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/interval.hpp>

namespace mckibben::diagnose {
namespace {

constexpr int draws = thresholds.interval.draws;

/// Errors of the scaled parameters that counting and its jitter alone make, times their transpose, on
/// average. A load at rest has one error for as long as it rests, and the same in every run that rests there;
/// so the encoder is simulated on the fitted motion, moved by changes of the parameters that are drawn from
/// `spread`, widened until they move the load by about a count. `gain`: from residuals to parameters.
Eigen::MatrixXd counting_errors(const Experiment& experiment, const Fitted& fitted, const Runs& runs,
                                const Eigen::MatrixXd& gain, const Eigen::MatrixXd& spread) {
  const auto size = gain.rows();
  Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(size, size);
  const NoiseFloor& floor = experiment.floor();
  if (floor.count <= 0.0) return errors;
  const double counts = floor.judged / floor.count;  // to a residual of one
  const auto parts = experiment.parts(runs);
  double moved = 0.0, rows = 0.0;
  for (const auto& part : parts) {
    const auto columns = fitted.columns.middleRows(part.begin, part.rows);
    moved += counts * counts * (columns * spread).cwiseProduct(columns).sum();
    rows += static_cast<double>(part.rows);
  }
  const double wider = std::max(1.0, std::sqrt(rows / std::max(moved, thresholds.interval.still)));
  const Eigen::MatrixXd root = wider * Eigen::MatrixXd(spread.llt().matrixL());
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Eigen::VectorXd noise = Eigen::VectorXd::Zero(fitted.residuals.size());
  for (int draw = 0; draw < draws; ++draw) {
    Eigen::VectorXd change(size);
    for (double& one : change) one = normal(random);
    const Eigen::VectorXd motion = counts * (fitted.columns * (root * change));
    for (const auto& part : parts) {
      plant::PulseCounter counter(experiment.data().rig.sensors.position().wiring, 1.0);
      const auto& measured = experiment.data().runs[part.run].judged();
      for (Eigen::Index k = 0; k < part.rows; ++k) {
        const Eigen::Index row = part.begin + k;
        const double at = measured[static_cast<std::size_t>(k)] / floor.count + 0.5 -
                          counts * fitted.residuals[row] + motion[row];
        const auto counted = counter.count(at + floor.jitter / floor.count * normal(random));
        noise[row] = (static_cast<double>(counted) + 0.5 - at) / counts;
      }
    }
    const Eigen::VectorXd error = gain * noise;
    errors += error * error.transpose() / draws;
  }
  return errors;
}

}  // namespace

Scatter scatter_of(const Experiment& experiment, const Runs& runs, const Eigen::MatrixXd& columns,
                   const Eigen::VectorXd& residuals, double inflation) {
  const Eigen::Index segment = segment_rows(experiment);
  Scatter scatter{Eigen::MatrixXd::Zero(columns.cols(), columns.cols()), 0};
  Eigen::Index begin = 0;
  for (const std::size_t run : runs) {
    const auto rows = static_cast<Eigen::Index>(experiment.rows(run));
    for (Eigen::Index at = 0; at < rows; at += segment, ++scatter.segments) {
      const Eigen::Index length = std::min(segment, rows - at);
      const Eigen::VectorXd score = columns.middleRows(begin + at, length).transpose() *
                                    residuals.segment(begin + at, length) / inflation;
      scatter.scores += score * score.transpose();
    }
    begin += rows;
  }
  return scatter;
}

std::vector<Bounds> intervals(const Experiment& experiment, const Fitted& fitted, const Runs& runs,
                              double inflation, double deviations) {
  const auto& free = fitted.model.free;
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd priors = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index j = 0; j < count; ++j)
    if (free[static_cast<std::size_t>(j)].has_prior) priors(j, j) = 1.0;
  const Eigen::MatrixXd information = fitted.columns.transpose() * fitted.columns / inflation + priors;
  const auto [scatter, segments] = scatter_of(experiment, runs, fitted.columns, fitted.residuals, inflation);
  const Eigen::MatrixXd inverse = information.ldlt().solve(Eigen::MatrixXd::Identity(count, count));
  const Eigen::MatrixXd robust = inverse * (priors + scatter) * inverse;
  const Eigen::MatrixXd counted =
      inverse * priors * inverse + counting_errors(experiment, fitted, runs,
                                                   inverse * fitted.columns.transpose() / inflation,
                                                   robust + inverse);
  // So many numbers that were fitted to so few segments have taken this share out of their scatter.
  const double taken = std::min(1.0, static_cast<double>(count) / static_cast<double>(segments));
  std::vector<Bounds> list;
  for (Eigen::Index j = 0; j < count; ++j) {
    const Parameter& p = free[static_cast<std::size_t>(j)];
    const double value = value_of(fitted.model.rig, p.path);
    const double half = deviations * std::sqrt(std::max(robust(j, j) + taken * inverse(j, j), counted(j, j)));
    const double at = p.scaled(value), rise = half * half / inverse(j, j);
    const double ends[] = {p.unscaled(at - half), p.unscaled(at + half)};
    const double low = std::min(ends[0], ends[1]), high = std::max(ends[0], ends[1]);
    if (p.period > 0.0)
      list.push_back({value, std::max(low, value - 0.5 * p.period), std::min(high, value + 0.5 * p.period),
                      high - low < p.period, half, rise});
    else
      list.push_back({value, std::clamp(low, p.lowest, p.highest), std::clamp(high, p.lowest, p.highest),
                      low > p.lowest || high < p.highest, half, rise});
  }
  return list;
}

}  // namespace mckibben::diagnose
