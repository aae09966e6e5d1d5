// See the header.
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

Eigen::VectorXd held_out(const Model& model, const std::vector<std::vector<std::size_t>>& groups) {
  const Eigen::VectorXd weight = model.variance().cwiseInverse(),
                        v = model.problem->dictionary.vector(model.point);
  const Eigen::MatrixXd whole = model.grams.sum();
  const Index k = v.size();
  Eigen::VectorXd list(std::ssize(groups));
  for (std::size_t i = 0; i < groups.size(); ++i) {
    Eigen::MatrixXd mine = Eigen::MatrixXd::Zero(k + 1, k + 1);
    double log_det = 0.0;
    for (const std::size_t run : groups[i]) {
      mine += model.grams.of_runs[run];
      log_det += model.grams.log_dets[run];
    }
    double value = -0.5 * log_det;
    if (k == 0) {
      value -= 0.5 * mine(0, 0);
    } else {
      // The posterior of the others, as a normal in numbers less the optimum.
      const Eigen::MatrixXd of_others = curvature(whole - mine, weight);
      const Eigen::LLT<Eigen::MatrixXd> others(of_others);
      const Eigen::VectorXd m =
          others.solve(Eigen::VectorXd((whole - mine).col(0).tail(k) - weight.cwiseProduct(v)));
      const Eigen::MatrixXd g = mine.bottomRightCorner(k, k);
      const Eigen::VectorXd along = mine.col(0).tail(k);
      const double square = mine(0, 0) - 2.0 * m.dot(along) + m.dot(g * m);
      const Eigen::VectorXd u = along - g * m;
      const Eigen::LLT<Eigen::MatrixXd> all(Eigen::MatrixXd(of_others + g));
      value -= 0.5 * (square - u.dot(all.solve(u)));
      value -=
          all.matrixLLT().diagonal().array().log().sum() - others.matrixLLT().diagonal().array().log().sum();
    }
    list[static_cast<Index>(i)] = value;
  }
  return list;
}

}  // namespace mckibben::identify
