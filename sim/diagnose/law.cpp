// Forward selection of force terms; see the header.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include <plant/geometry.hpp>
#include <sim/diagnose/candidate.hpp>
#include <sim/diagnose/interval.hpp>
#include <sim/diagnose/law.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

using plant::Basis;

constexpr const LawThresholds& of_law = thresholds.law;

std::vector<plant::ForceTerm>& terms_of(plant::Effects& effects) {
  return effects.get<plant::ResidualForce>().terms;
}

/// Of a pair, each muscle gets the force.
void add(Rig& rig, const plant::ForceTerm& term) {
  each_side(rig, [&](plant::Effects& effects) { terms_of(effects).push_back(term); });
}

plant::ForceTerm wave(double probe_N, double wavelength_m, double phase_rad) {
  return {.of = Basis::sine, .coefficient_N = probe_N, .wavelength_m = wavelength_m, .phase_rad = phase_rad};
}

/// Wavelengths that the data can tell apart: whole and half periods over the largest rise.
std::vector<double> wavelengths_m(const Rig& rig) {
  const double rise_m = plant::Braid(rig.muscle).largest_contraction_ratio() * rig.muscle.rest_length_m;
  std::vector<double> list;
  for (double periods = of_law.first_periods; periods <= of_law.last_periods; periods += of_law.step_periods)
    list.push_back(rise_m / periods);
  return list;
}

struct Proposal {
  double drop = 0.0;
  plant::ForceTerm term{};
};

/// Terms of which slopes are taken: plain ones, then for each wave its sine and its cosine.
struct Probes {
  std::vector<plant::ForceTerm> terms{};
  std::size_t plain = 0;
};

Probes probes_of(const Rig& rig) {
  Probes probes;
  for (const auto& [basis, name] : names(Basis{})) {
    if (basis == Basis::sine || basis == Basis::constant) continue;
    for (const double probe_N : of_law.probes_N)
      probes.terms.push_back({.of = basis, .coefficient_N = probe_N});
  }
  probes.plain = probes.terms.size();
  for (const double wavelength : wavelengths_m(rig)) {
    for (const double probe_N : of_law.wave_probes_N) {
      probes.terms.push_back(wave(probe_N, wavelength, 0.0));
      probes.terms.push_back(wave(probe_N, wavelength, std::numbers::pi / 2.0));
    }
  }
  return probes;
}

/// What each probe promises, next to what is free already.
std::vector<Proposal> score(const Case& c, const Fitted& fitted, const Probes& probes) {
  std::vector<Experiment::Change> changes;
  changes.reserve(probes.terms.size());
  for (const auto& term : probes.terms)
    changes.push_back({[term](Loaded& h) { add(h.rig, term); }, term.coefficient_N, true});
  const auto slopes = c.experiment.slopes(fitted.model.rig, changes, c.split.training);
  // As long as nothing fits, the misfit itself is the scatter.
  const Projector project(
      fitted, std::max(c.inflation, variance_inflation(c.experiment, fitted.residuals, c.split.training)));
  const Eigen::VectorXd residuals = project(fitted.residuals);
  std::vector<Proposal> list;
  const auto column = [&](std::size_t i) {
    return project(slopes.columns.col(static_cast<Eigen::Index>(i)));
  };
  for (std::size_t i = 0; i < probes.plain; ++i) {
    const Eigen::VectorXd slope = column(i);
    const double along = slope.dot(residuals), length = slope.squaredNorm();
    if (length < of_law.no_slope) continue;
    list.push_back({along * along / length, probes.terms[i]});
    list.back().term.coefficient_N = along / length;
  }
  for (std::size_t i = probes.plain; i < probes.terms.size(); i += 2) {
    Eigen::MatrixXd pair(residuals.size(), 2);
    pair << column(i), column(i + 1);
    const Eigen::Matrix2d normal = pair.transpose() * pair;
    const Eigen::Vector2d along = pair.transpose() * residuals;
    const Eigen::Vector2d size = normal.ldlt().solve(along);
    list.push_back(
        {size.dot(along), wave(size.norm(), probes.terms[i].wavelength_m, std::atan2(size[1], size[0]))});
  }
  return list;
}

/// The terms that promise most: one of each kind, best first.
std::vector<Proposal> propose(const Case& c, const Fitted& fitted) {
  std::vector<Proposal> list = score(c, fitted, probes_of(c.nominal));
  std::erase_if(list, [](const Proposal& p) { return !(p.drop > 0.0); });
  std::stable_sort(list.begin(), list.end(),
                   [](const Proposal& a, const Proposal& b) { return a.drop > b.drop; });
  const auto same_kind = [](const plant::ForceTerm& a, const plant::ForceTerm& b) {
    return a.of == b.of && std::abs(std::log(a.wavelength_m / b.wavelength_m)) < of_law.same_wave;
  };
  std::vector<Proposal> best;
  for (const Proposal& proposal : list) {
    const bool known = std::any_of(best.begin(), best.end(), [&](const Proposal& other) {
      return same_kind(other.term, proposal.term);
    });
    if (!known && best.size() < of_law.most_fits) best.push_back(proposal);
  }
  return best;
}

/// The model with a term more, and what is free in it.
Model with_term(const Model& model, const plant::ForceTerm& term) {
  Model bigger = model;
  const bool both_sides = model.rig.pair() != nullptr;
  const std::string path = fmt::format("effects.residual_law.terms.{}.", terms_of(bigger.rig.effects).size());
  add(bigger.rig, term);
  bigger.free.push_back({.path = path + "coefficient",
                         .scale = 1.0,
                         .step = of_law.step_N,
                         .lowest = -of_law.most_N,
                         .highest = of_law.most_N,
                         .both_sides = both_sides});
  if (term.of == Basis::sine) {
    bigger.free.push_back({.path = path + "wavelength",
                           .step = of_law.wave_step,
                           .lowest = of_law.shorter * term.wavelength_m,
                           .highest = of_law.longer * term.wavelength_m,
                           .logarithmic = true,
                           .both_sides = both_sides});
    bigger.free.push_back({.path = path + "phase",
                           .scale = 1.0,
                           .step = of_law.wave_step,
                           .lowest = -of_law.most_phase,
                           .highest = of_law.most_phase,
                           .period = 2.0 * std::numbers::pi,
                           .both_sides = both_sides});
  }
  return bigger;
}

/// The model without one of its terms.
Model without_term(const Model& model, std::size_t term) {
  Model smaller = model;
  const auto prefix = [](std::size_t index) { return fmt::format("effects.residual_law.terms.{}.", index); };
  std::erase_if(smaller.free, [&](const Parameter& p) { return p.path.starts_with(prefix(term)); });
  for (std::size_t next = term + 1; next < terms_of(smaller.rig.effects).size(); ++next)
    for (Parameter& p : smaller.free)
      if (p.path.starts_with(prefix(next))) p.path = prefix(next - 1) + p.path.substr(prefix(next).size());
  each_side(smaller.rig, [&](plant::Effects& effects) {
    terms_of(effects).erase(terms_of(effects).begin() + static_cast<std::ptrdiff_t>(term));
  });
  return smaller;
}

/// What was taken first may have stood in for what came after it.
void drop_needless(const Case& c, Law& law, const Step& step) {
  for (std::size_t i = 0; law.terms > 1 && i < law.terms;) {
    step("without one term");
    const auto& terms = law.contender.fitted.model.rig.effects.get<plant::ResidualForce>().terms;
    auto shorter = contend(c, without_term(law.contender.fitted.model, terms.size() - law.terms + i));
    if (!shorter.fitted.failure.empty() ||
        convinces(compare(c.experiment, shorter.held_out, law.contender.held_out, c.split.held_out))) {
      ++i;
    } else {
      law.contender = std::move(shorter);
      --law.terms;
    }
  }
}

/// Drops terms whose 99 % interval says nothing, not even their sign.
void drop_uncertain(const Case& c, Law& law, const Step& step) {
  for (std::size_t i = 0; i < law.terms;) {
    const Fitted& fitted = law.contender.fitted;
    const double inflation = variance_inflation(c.experiment, fitted.residuals, c.split.training);
    const auto bounds =
        intervals(c.experiment, fitted, c.split.training, inflation, thresholds.interval.certain);
    const std::size_t all = fitted.model.rig.effects.get<plant::ResidualForce>().terms.size();
    const std::size_t term = all - law.terms + i;
    const std::string path = fmt::format("effects.residual_law.terms.{}.", term);
    bool certain = true;
    for (std::size_t j = 0; j < bounds.size(); ++j) {
      const std::string& name = fitted.model.free[j].path;
      if (!name.starts_with(path)) continue;
      const bool sign = bounds[j].low > 0.0 || bounds[j].high < 0.0;
      certain = certain && bounds[j].determined && (sign || !name.ends_with("coefficient"));
    }
    if (certain) {
      ++i;
      continue;
    }
    step("without one term");
    auto shorter = contend(c, without_term(fitted.model, term));
    if (!shorter.fitted.failure.empty()) return;
    law.contender = std::move(shorter);
    --law.terms;
    i = 0;
  }
}

/// Terms are counted through on both sides of a pair alike.
bool sides_have_as_many_terms(Rig rig) {
  const std::size_t count = terms_of(rig.effects).size();
  bool alike = true;
  each_side(rig, [&](plant::Effects& effects) { alike = alike && terms_of(effects).size() == count; });
  return alike;
}

/// Term by term, as long as each helps.
void extend_law(const Case& c, const std::vector<const Contender*>& bases, const Eigen::VectorXd& reference,
                const Step& step, Law& law) {
  Eigen::VectorXd before = reference;
  step(stage("looking for a law", of_law.most_terms));
  for (std::size_t round = 0; round < of_law.most_terms; ++round) {
    step(fmt::format("term {}", round + 1));
    std::optional<Contender> next;
    const auto extend = [&](const Contender& base) {
      const auto known = slopes_of_nominal(base.fitted);
      for (const Proposal& proposal : propose(c, base.fitted)) {
        auto longer = contend(c, with_term(base.fitted.model, proposal.term), {.known = &known});
        if (longer.fitted.failure.empty() && (!next || longer.fitted.cost < next->fitted.cost))
          next = std::move(longer);
      }
    };
    if (round == 0)
      for (const Contender* base : bases) extend(*base);
    else
      extend(law.contender);
    if (!next) break;
    begin_too(c, *next, next->fitted.model);
    if (!convinces(compare(c.experiment, before, next->held_out, c.split.held_out))) break;
    ++law.terms;
    law.contender = std::move(*next);
    before = law.contender.held_out;
    if (excess(before) < thresholds.decide.worth_a_law) break;  // a term more would describe noise
  }
  drop_needless(c, law, step);
}

}  // namespace

Law find_law(const Case& c, const std::vector<const Contender*>& bases, const Eigen::VectorXd& reference,
             const Step& step, Search& search) {
  Law law{.contender = *bases.front()};
  if (sides_have_as_many_terms(c.nominal))
    search.part("a law of force", [&] { extend_law(c, bases, reference, step, law); });
  drop_uncertain(c, law, step);
  law.gain = compare(c.experiment, reference, law.contender.held_out, c.split.held_out);
  return law;
}

}  // namespace mckibben::diagnose
