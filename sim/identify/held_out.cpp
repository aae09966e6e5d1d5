// See the header.
#include <algorithm>
#include <map>

#include <Eigen/Cholesky>

#include <sim/identify/held_out.hpp>
#include <sim/identify/quadratic.hpp>

namespace mckibben::identify {

using Eigen::Index;

std::vector<std::vector<std::size_t>> groups_of(const Rows& rows) {
  std::map<double, std::vector<std::size_t>> by_load;
  for (std::size_t run = 0; run < rows.runs.size(); ++run)
    by_load[rows.data().runs[rows.runs[run]].load_kg].push_back(run);
  std::vector<std::vector<std::size_t>> groups;
  if (by_load.size() >= 3) {
    for (auto& [load, runs] : by_load) groups.push_back(std::move(runs));
  } else {
    for (std::size_t run = 0; run < rows.runs.size(); ++run) groups.push_back({run});
  }
  return groups;
}

namespace {

/// A model's quadratic without the runs of a group: in numbers less where the model stands.
struct Others {
  Eigen::MatrixXd mine;  ///< Gram matrix of the group
  double log_det = 0.0;
  Eigen::MatrixXd curvature_;
  Eigen::LLT<Eigen::MatrixXd> factor;
  Eigen::VectorXd most_probable;

  Others(const Model& model, const std::vector<std::size_t>& group) {
    const Eigen::VectorXd weight = model.variance().cwiseInverse(),
                          v = model.problem->dictionary.vector(model.point);
    const Index k = v.size();
    mine = Eigen::MatrixXd::Zero(k + 1, k + 1);
    for (const std::size_t run : group) {
      mine += model.grams.of_runs[run];
      log_det += model.grams.log_dets[run];
    }
    if (k == 0) return;
    const Eigen::MatrixXd rest = model.grams.sum() - mine;
    curvature_ = curvature(rest, weight);
    factor.compute(curvature_);
    most_probable = factor.solve(Eigen::VectorXd(rest.col(0).tail(k) - weight.cwiseProduct(v)));
  }
};

}  // namespace

Eigen::VectorXd held_out(const Model& model, const std::vector<std::vector<std::size_t>>& groups) {
  const Index k = model.grams.of_runs.front().cols() - 1;
  Eigen::VectorXd list(std::ssize(groups));
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Others others(model, groups[i]);
    const Eigen::MatrixXd& mine = others.mine;
    double value = -0.5 * others.log_det;
    if (k == 0) {
      value -= 0.5 * mine(0, 0);
    } else {
      const Eigen::VectorXd& m = others.most_probable;
      const Eigen::MatrixXd g = mine.bottomRightCorner(k, k);
      const Eigen::VectorXd along = mine.col(0).tail(k);
      const double square = mine(0, 0) - 2.0 * m.dot(along) + m.dot(g * m);
      const Eigen::VectorXd u = along - g * m;
      const Eigen::LLT<Eigen::MatrixXd> all(Eigen::MatrixXd(others.curvature_ + g));
      value -= 0.5 * (square - u.dot(all.solve(u)));
      value -= all.matrixLLT().diagonal().array().log().sum() -
               others.factor.matrixLLT().diagonal().array().log().sum();
    }
    list[static_cast<Index>(i)] = value;
  }
  return list;
}

Eigen::VectorXd unpredicted(const Model& model, const std::vector<std::vector<std::size_t>>& groups) {
  const Rows& rows = model.problem->rows;
  Eigen::VectorXd left = model.residual();
  if (model.slopes.cols() > 0)
    for (const auto& group : groups) {
      const Eigen::VectorXd step = Others(model, group).most_probable;
      for (const Block& block : rows.blocks)
        if (std::ranges::find(group, block.run) != group.end())
          left.segment(block.begin, block.rows) -= model.slopes.middleRows(block.begin, block.rows) * step;
    }
  return left - of_runs(model, left);
}

Eigen::VectorXd of_runs(const Model& model, const Eigen::VectorXd& left) {
  const Rows& rows = model.problem->rows;
  Eigen::VectorXd list = Eigen::VectorXd::Zero(left.size());
  const std::vector<Eigen::VectorXd> means = model.error.grams(left, Eigen::MatrixXd(left.size(), 0)).means;
  if (means.empty()) return list;
  for (const Block& block : rows.blocks) {
    const Eigen::VectorXd& mean = means[block.run];
    auto part = list.segment(block.begin, block.rows);
    for (std::size_t i = 0; i < model.point.differ.size() && rows.is_judged(block); ++i) {
      const double value = mean[static_cast<Index>(i)];
      part += value * model.error.per_unit(model.point.differ[i], block);
    }
    if (model.error.starts() > 0)
      part += model.error.started(block, mean.tail(static_cast<Index>(model.error.starts())));
  }
  return list;
}

}  // namespace mckibben::identify
