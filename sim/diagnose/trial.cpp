// See the header.
#include <algorithm>
#include <cmath>

#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/diagnosis.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/diagnose/trial.hpp>
#include <sim/engine/failure.hpp>

namespace mckibben::diagnose {

std::string title(const Candidate& c) {
  return full_name(c.effect, c.variant, c.side);
}

bool has_size(const Model& model, const Candidate& c) {
  const double value = value_of(model.rig, c.amplitude);
  for (const Parameter& p : model.free) {
    if (p.path != c.amplitude) continue;
    const double edge = thresholds.name.at_bound * (p.highest - p.lowest);
    const bool at_bound = value > p.highest - edge || (value < p.lowest + edge && c.either_sign);
    return !at_bound && std::abs(value - c.absent) > thresholds.name.to_nothing *
                                                         thresholds.parameter.least_size *
                                                         std::abs(c.typical);
  }
  return false;
}

bool has_shape(const Model& model, const Candidate& c) {
  return std::ranges::none_of(model.free, [&](const Parameter& p) {
    if (p.path != c.shape) return false;
    const double value = p.scaled(value_of(model.rig, p.path)), lowest = p.scaled(p.lowest),
                 highest = p.scaled(p.highest), edge = thresholds.name.at_bound * (highest - lowest);
    return value < lowest + edge || value > highest - edge;
  });
}

bool goes_with(const EffectName& who, std::string_view variant, const Candidate& gone) {
  return who == gone.who() && (gone.adds_to.empty() || variant == gone.variant);
}

Model without(const Model& model, std::size_t effect) {
  Model smaller = model;
  const Candidate& gone = model.effects[effect];
  for (const Candidate& c : model.effects) {
    if (!goes_with(c.who(), c.variant, gone)) continue;
    smaller.rig = c.removed(smaller.rig);
    std::erase_if(smaller.free, [&](const Parameter& p) { return c.moves(p.path); });
  }
  std::erase_if(smaller.effects, [&](const Candidate& c) { return goes_with(c.who(), c.variant, gone); });
  return smaller;
}

Contender contend(const Case& c, Model model, FitSettings settings) {
  Contender contender;
  settings.inflation = c.inflation;
  contender.fitted = fit(c.experiment, std::move(model), c.split.training, settings);
  if (!contender.fitted.failure.empty()) return contender;
  try {
    contender.held_out = c.experiment.residuals(contender.fitted.model.rig, c.split.held_out);
  } catch (const engine::NumericalFailure& failure) {
    contender.fitted.failure = failure.what();
  }
  if (c.fitted) c.fitted(contender);
  return contender;
}

Model with(const Case& c, const Model& model, const Score& score) {
  const Candidate& candidate = score.candidate;
  Model bigger = model;
  bigger.rig = candidate.chosen(bigger.rig);
  const auto parameters = candidate.parameters(bigger.rig);
  // The score is a straight line drawn at nothing; the law may bend.
  double least = 0.0, best = candidate.absent;
  for (const double share : thresholds.name.first_sizes) {
    const double size = std::clamp(candidate.absent + share * (score.amplitude - candidate.absent),
                                   parameters[0].lowest, parameters[0].highest);
    candidate.put(bigger.rig, size, score.shape);
    double squares = 0.0;
    try {
      squares = c.experiment.residuals(bigger.rig, c.split.training).squaredNorm();
    } catch (const engine::NumericalFailure&) {
      continue;  // too much of it for the rig to move
    }
    if (best == candidate.absent || squares < least) {
      least = squares;
      best = size;
    }
  }
  candidate.put(bigger.rig, best, score.shape);
  bigger.free.insert(bigger.free.end(), parameters.begin(), parameters.end());
  bigger.effects.push_back(candidate);
  return bigger;
}

namespace {

/// What a fit to `runs` says of `few` of them: residuals and slopes. The cost is that of all.
Fitted part_of(const Fitted& fitted, const Experiment& experiment, const Runs& runs, const Runs& few) {
  std::vector<Eigen::Index> kept;
  Eigen::Index row = 0;
  for (const std::size_t run : runs) {
    const bool wanted = std::find(few.begin(), few.end(), run) != few.end();
    for (std::size_t k = 0; k < experiment.rows(run); ++k, ++row)
      if (wanted) kept.push_back(row);
  }
  return {fitted.model, fitted.residuals(kept), fitted.columns(kept, Eigen::all), fitted.cost,
          fitted.failure};
}

}  // namespace

Screening screen_at(const Case& c, const Contender& base) {
  // As long as nothing fits, the misfit itself is the scatter: no nominal parameter is worth believing far
  // from its data sheet for the sake of details.
  const double scatter =
      std::max(c.inflation, variance_inflation(c.experiment, base.fitted.residuals, c.split.training));
  const auto candidates = catalogue(c.experiment.data());
  const Runs few = asked(c.experiment.data(), c.split.training);
  const auto screened = [&](const Fitted& fitted, double scatter_of_rows) {
    Screening screening{&base, screen(c.experiment, fitted, candidates, few, scatter_of_rows),
                        scatter / c.inflation};
    join_sides(screening.scores, screening.finer);
    return screening;
  };
  if (few.size() == c.split.training.size()) return screened(base.fitted, scatter);
  // Each of their rows stands for several.
  const Fitted part = part_of(base.fitted, c.experiment, c.split.training, few);
  const double share =
      static_cast<double>(part.residuals.size()) / static_cast<double>(base.fitted.residuals.size());
  return screened(part, share * scatter);
}

Trial rough(const Case& c, const Contender& base, const Score& score, std::size_t place) {
  const auto known = slopes_of_nominal(base.fitted);
  return {score, place, contend(c, with(c, base.fitted.model, score), {.known = &known}), {}};
}

void begin_too(const Case& c, Contender& end, Model start, FitSettings settings) {
  Contender other = contend(c, std::move(start), settings);
  if (other.fitted.failure.empty() && other.fitted.cost < end.fitted.cost) end = std::move(other);
}

void polish(const Case& c, Trial& trial, const Step& step) {
  step("fitting " + title(trial.score.candidate));
  begin_too(c, trial.contender, trial.contender.fitted.model);
}

bool bent(const Fitted& fitted, double inflation) {
  constexpr double most = thresholds.parameter.at_the_edge * thresholds.parameter.most_deviations;
  const bool at_bounds = std::ranges::any_of(fitted.model.free, [&](const Parameter& p) {
    const double value = value_of(fitted.model.rig, p.path),
                 edge = thresholds.name.at_bound * (p.highest - p.lowest);
    return p.has_prior && !p.of_effect() && std::abs(p.deviations(value)) >= most &&
           (value < p.lowest + edge || value > p.highest - edge);
  });
  return at_bounds && fitted.cost - least_by_lines(fitted, inflation) > thresholds.near.clear;
}

bool is_doubtful(const Case& c, const Contender& end) {
  return excess(end.held_out) > thresholds.name.worth_a_pair || bent(end.fitted, c.inflation);
}

bool meets(const Contender& contender) {
  const double nothing = thresholds.near.nothing_left;
  return excess(contender.held_out) < nothing && excess(contender.fitted.residuals) < 2.0 * nothing;
}

bool as_good(const Case& c, const Contender& chosen, const Contender& rival) {
  const auto worse = compare(c.experiment, rival.held_out, chosen.held_out, c.split.held_out);
  const double costlier = rival.fitted.cost - chosen.fitted.cost;
  return (costlier < thresholds.near.clear && !convinces(worse)) ||
         (worse.gained < thresholds.name.as_good_gained &&
          costlier < thresholds.name.as_good_cost * chosen.fitted.cost);
}

}  // namespace mckibben::diagnose
