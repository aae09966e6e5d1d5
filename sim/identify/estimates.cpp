// See the header.
#include <cmath>

#include <fmt/format.h>

#include <sim/identify/estimates.hpp>

namespace mckibben::identify {
namespace {

/// Calls `visit` with each number of a kind: its coordinate, where it is, its deviation, in units of its
/// prior.
template <class Visit>
void each(const Model& model, const Visit& visit) {
  const Eigen::VectorXd v = model.problem->dictionary.vector(model.point);
  Eigen::Index j = 0;
  for (const Coordinate& one : model.problem->dictionary.coordinates(model.point)) {
    visit(one, v[j], std::sqrt(model.covariance(j, j)));
    ++j;
  }
}

}  // namespace

std::vector<Estimate> sizes_of(const Model& model) {
  std::vector<Estimate> list;
  each(model, [&](const Coordinate& one, double z, double deviation) {
    if (one.kind != Kind::size && one.kind != Kind::shape) return;
    const Entry& entry = model.problem->dictionary.entries[model.point.effects[one.of].entry];
    if (one.kind == Kind::shape) {
      const double shape = entry.shape_middle * std::exp(entry.shape_sd * z);
      list.push_back({entry.effect->shape, "", shape, shape * entry.shape_sd * deviation});
    } else {
      list.push_back({entry.bench != nullptr ? fmt::format("{}.{}", entry.name, entry.bench->variant)
                                             : entry.effect->amplitude,
                      "", entry.absent + entry.typical * z, std::abs(entry.typical) * deviation});
    }
  });
  return list;
}

std::vector<Estimate> parameters_of(const Model& model) {
  std::vector<Estimate> list;
  each(model, [&](const Coordinate& one, double z, double deviation) {
    if (one.kind != Kind::parameter) return;
    const auto& p = model.problem->dictionary.parameters[one.of];
    list.push_back({p.difference ? p.path + ", difference" : p.path, "deviations", z, deviation});
  });
  return list;
}

}  // namespace mckibben::identify
