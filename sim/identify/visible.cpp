// See the header.
#include <algorithm>
#include <map>

#include <Eigen/Cholesky>

#include <sim/identify/quadratic.hpp>
#include <sim/identify/screen.hpp>
#include <sim/identify/visible.hpp>

namespace mckibben::identify {
namespace {

constexpr double would_show = 6.0;  // nats that an effect of the usual size would gain, as a rule

}  // namespace

Visible visible(const Model& model) {
  const Dictionary& dictionary = model.problem->dictionary;
  std::vector<Probe> list = probes(dictionary, model.point);
  std::erase_if(list, [&](const Probe& one) {
    const Entry& entry = dictionary.entries[one.entry];
    return one.size != 1.0 || one.shapes != entry.begin.front() || !entry.effect;
  });
  std::map<std::string, bool> shown;
  for (const Probe& one : list) shown[dictionary.entries[one.entry].effect->effect] = false;
  const Eigen::MatrixXd columns = columns_of(model, list);
  const Eigen::Index k = model.slopes.cols();
  const Eigen::MatrixXd gram = model.error
                                   .grams(model.residual(),
                                          [&] {
                                            Eigen::MatrixXd all(columns.rows(), k + columns.cols());
                                            all << model.slopes, columns;
                                            return all;
                                          }())
                                   .sum();
  const Eigen::LLT<Eigen::MatrixXd> parameters(
      curvature(gram.topLeftCorner(k + 1, k + 1), model.variance().cwiseInverse()));
  for (std::size_t j = 0; j < list.size(); ++j) {
    const auto at = k + 1 + static_cast<Eigen::Index>(j);
    const Eigen::VectorXd along = gram.col(at).segment(1, k);
    const double gain = 0.5 * (gram(at, at) - (k > 0 ? along.dot(parameters.solve(along)) : 0.0));
    bool& is_shown = shown[dictionary.entries[list[j].entry].effect->effect];
    is_shown = is_shown || gain > would_show;
  }
  Visible result{.hidden = {}, .all = shown.size()};
  for (const auto& [effect, is_shown] : shown)
    if (!is_shown) result.hidden.push_back(effect);
  return result;
}

}  // namespace mckibben::identify
