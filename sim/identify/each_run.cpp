// See the header.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <sim/data/series.hpp>
#include <sim/identify/each_run.hpp>

namespace mckibben::identify {

double EachRun::deviation(const Eigen::VectorXd& of) const {
  return std::sqrt(of.dot(covariance * of));
}
std::vector<double> EachRun::deviations() const {
  const Eigen::VectorXd list = covariance.diagonal().cwiseSqrt();
  return {list.begin(), list.end()};
}

Common::Common(const std::vector<double>& values, Eigen::VectorXd of) : sizes(std::move(of)) {
  const auto share = [&](std::size_t i) { return values[i] / sizes[static_cast<Eigen::Index>(i)]; };
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, share);
  weights = Eigen::VectorXd::Zero(sizes.size());
  const std::size_t half = order.size() / 2;
  for (const std::size_t at : {half, order.size() - half - 1}) {
    weights[static_cast<Eigen::Index>(order[at])] += 0.5 / sizes[static_cast<Eigen::Index>(order[at])];
    value += 0.5 * share(order[at]);
  }
}

Eigen::VectorXd Common::own(Eigen::Index run) const {
  return Eigen::VectorXd::Unit(sizes.size(), run) - sizes[run] * weights;
}

std::vector<double> Common::owns(const std::vector<double>& values) const {
  std::vector<double> list = values;
  for (std::size_t i = 0; i < list.size(); ++i) list[i] -= sizes[static_cast<Eigen::Index>(i)] * value;
  return list;
}

double Common::spread(const std::vector<double>& values) const {
  std::vector<double> list = owns(values);
  for (double& one : list) one = std::abs(one);
  return data::median(std::move(list));
}

std::vector<double> values_of(const Model& model, std::size_t place) {
  std::vector<double> list;
  for (const Eigen::VectorXd& mean : model.grams.means)
    list.push_back(mean[static_cast<Eigen::Index>(place)]);
  return list;
}

EachRun each_run(const Model& model, std::size_t place) {
  EachRun list{.values = values_of(model, place)};
  const auto i = static_cast<Eigen::Index>(place);
  const Eigen::Index runs = std::ssize(list.values), k = model.slopes.cols();
  // How the values change with the model's parameters, which are not known either.
  Eigen::MatrixXd change(runs, k);
  for (Eigen::Index j = 0; j < k; ++j) {
    const Grams by = model.error.grams(model.slopes.col(j), Eigen::MatrixXd(model.slopes.rows(), 0));
    for (Eigen::Index run = 0; run < runs; ++run) change(run, j) = by.means[static_cast<std::size_t>(run)][i];
  }
  list.covariance = change * model.covariance * change.transpose();
  for (Eigen::Index run = 0; run < runs; ++run)
    list.covariance(run, run) += std::pow(model.grams.deviations[static_cast<std::size_t>(run)][i], 2);
  return list;
}

bool most_are_right(const Grams& grams, const Point& point, int which) {
  constexpr double right = 0.1;  // of the largest
  const auto place = std::ranges::find(point.differ, which) - point.differ.begin();
  std::vector<double> off;
  for (const Eigen::VectorXd& mean : grams.means) off.push_back(std::abs(mean[place]));
  return data::median(off) < right * std::ranges::max(off);
}

}  // namespace mckibben::identify
