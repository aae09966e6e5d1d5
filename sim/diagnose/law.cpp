// Forward selection of force terms; see the header.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/diagnose/law.hpp>

namespace mckibben::diagnose {
namespace {

using plant::Basis;

constexpr std::size_t most_terms = 3;
constexpr double probe_N = 0.01;  ///< force for slopes

plant::ForceTerm wave(double wavelength_m, double phase_rad) {
  return {.of = Basis::sine, .coefficient_N = probe_N, .wavelength_m = wavelength_m, .phase_rad = phase_rad};
}

/// Wavelengths that the data can tell apart: whole and half periods over the largest rise.
std::vector<double> wavelengths_m(const plant::Rig& rig) {
  const double rise_m = plant::Braid(rig.muscle).largest_contraction_ratio() * rig.muscle.rest_length_m;
  std::vector<double> list;
  for (double periods = 1.0; periods <= 20.0; periods += 0.5) list.push_back(rise_m / periods);
  return list;
}

struct Proposal {
  double drop = 0.0;
  plant::ForceTerm term{};
};

/// The term that promises most, next to what is free already.
Proposal propose(const Case& c, const Fitted& fitted) {
  std::vector<plant::ForceTerm> probes;
  for (const auto& [basis, name] : names(Basis{})) {
    if (basis != Basis::sine && basis != Basis::constant)
      probes.push_back({.of = basis, .coefficient_N = probe_N});
  }
  const std::size_t plain = probes.size();
  for (const double wavelength : wavelengths_m(c.nominal)) {
    probes.push_back(wave(wavelength, 0.0));
    probes.push_back(wave(wavelength, std::numbers::pi / 2.0));
  }
  std::vector<Experiment::Change> changes;
  changes.reserve(probes.size());
  for (const auto& term : probes)
    changes.push_back(
        {[term](Hanging& h) { h.rig.effects.get<plant::ResidualForce>().terms.push_back(term); }, 1.0});
  const auto slopes = c.experiment.slopes(fitted.model.rig, changes, c.split.training);
  const Projector project(fitted, c.temperature);
  const Eigen::VectorXd residuals = project(fitted.residuals);
  Proposal best;
  const auto column = [&](std::size_t i) {
    return project(slopes.columns.col(static_cast<Eigen::Index>(i)));
  };
  for (std::size_t i = 0; i < plain; ++i) {
    const Eigen::VectorXd slope = column(i);
    const double along = slope.dot(residuals), length = slope.squaredNorm();
    if (length < 1e-12 || along * along / length <= best.drop) continue;
    best = {along * along / length, probes[i]};
    best.term.coefficient_N = probe_N * along / length;
  }
  for (std::size_t i = plain; i < probes.size(); i += 2) {
    Eigen::MatrixXd pair(residuals.size(), 2);
    pair << column(i), column(i + 1);
    const Eigen::Matrix2d normal = pair.transpose() * pair;
    const Eigen::Vector2d along = pair.transpose() * residuals;
    const Eigen::Vector2d size = normal.ldlt().solve(along);
    const double drop = size.dot(along);
    if (!(drop > best.drop)) continue;
    best = {drop, wave(probes[i].wavelength_m, std::atan2(size[1], size[0]))};
    best.term.coefficient_N = probe_N * size.norm();
  }
  return best;
}

/// The model with a term more, and what is free in it.
Model with_term(const Model& model, const plant::ForceTerm& term) {
  Model bigger = model;
  auto& terms = bigger.rig.effects.get<plant::ResidualForce>().terms;
  const std::string path = fmt::format("effects.residual_law.terms.{}.", terms.size());
  terms.push_back(term);
  bigger.free.push_back(
      {.path = path + "coefficient", .scale = 1.0, .step = 0.01, .lowest = -1e3, .highest = 1e3});
  if (term.of == Basis::sine) {
    bigger.free.push_back({.path = path + "wavelength",
                           .step = 1e-3,
                           .lowest = 0.7 * term.wavelength_m,
                           .highest = 1.4 * term.wavelength_m,
                           .logarithmic = true});
    bigger.free.push_back(
        {.path = path + "phase", .scale = 1.0, .step = 1e-3, .lowest = -7.0, .highest = 7.0});
  }
  return bigger;
}

}  // namespace

Law find_law(const Case& c, const Contender& base, const Eigen::VectorXd& reference,
             const std::function<void(const std::string&)>& step) {
  Law law{.contender = base};
  Eigen::VectorXd before = reference;
  for (std::size_t round = 0; round < most_terms; ++round) {
    step(fmt::format("looking for a law, term {}", round + 1));
    const Proposal proposal = propose(c, law.contender.fitted);
    if (proposal.drop <= 0.0) break;
    auto next = contend(c, with_term(law.contender.fitted.model, proposal.term));
    if (!next.fitted.failure.empty()) break;
    if (!convinces(compare(c.experiment, before, next.held_out, c.split.held_out))) break;
    law.terms.push_back(next.fitted.model.rig.effects.get<plant::ResidualForce>().terms.size() - 1);
    law.contender = std::move(next);
    before = law.contender.held_out;
    if (excess(before) < 0.04) break;
  }
  law.gain = compare(c.experiment, reference, law.contender.held_out, c.split.held_out);
  return law;
}

}  // namespace mckibben::diagnose
