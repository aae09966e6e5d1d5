// Intervals; see the header.
#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include <sim/diagnose/interval.hpp>

namespace mckibben::diagnose {

std::vector<Bounds> intervals(const Experiment& experiment, const Fitted& fitted, const Runs& runs,
                              double temperature) {
  const auto& free = fitted.model.free;
  const auto count = static_cast<Eigen::Index>(free.size());
  const Eigen::Index segment = std::max<Eigen::Index>(1, std::lround(1.5 / experiment.data().rig.tick_s));
  Eigen::MatrixXd priors = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index j = 0; j < count; ++j)
    if (free[static_cast<std::size_t>(j)].has_prior) priors(j, j) = 1.0;
  const Eigen::MatrixXd information = fitted.columns.transpose() * fitted.columns / temperature + priors;
  Eigen::MatrixXd scatter = priors;
  Eigen::Index begin = 0, segments = 0;
  for (const std::size_t run : runs) {
    const auto rows = static_cast<Eigen::Index>(experiment.rows(run));
    for (Eigen::Index at = 0; at < rows; at += segment, ++segments) {
      const Eigen::Index length = std::min(segment, rows - at);
      const Eigen::VectorXd score = fitted.columns.middleRows(begin + at, length).transpose() *
                                    fitted.residuals.segment(begin + at, length) / temperature;
      scatter += score * score.transpose();
    }
    begin += rows;
  }
  const Eigen::MatrixXd inverse = information.ldlt().solve(Eigen::MatrixXd::Identity(count, count));
  const Eigen::MatrixXd robust = inverse * scatter * inverse;
  // Few clusters make the sandwich too optimistic: the wider of the two, and a little for their number.
  const double few =
      std::sqrt(static_cast<double>(segments) / std::max(1.0, static_cast<double>(segments - count)));
  std::vector<Bounds> list;
  for (Eigen::Index j = 0; j < count; ++j) {
    const Parameter& p = free[static_cast<std::size_t>(j)];
    const double value = value_of(fitted.model.rig, p.path);
    const double half = 1.96 * few * std::sqrt(std::max(robust(j, j), inverse(j, j)));
    const double at = p.scaled(value);
    const double ends[] = {p.unscaled(at - half), p.unscaled(at + half)};
    list.push_back({value, std::clamp(std::min(ends[0], ends[1]), p.lowest, p.highest),
                    std::clamp(std::max(ends[0], ends[1]), p.lowest, p.highest)});
  }
  return list;
}

}  // namespace mckibben::diagnose
