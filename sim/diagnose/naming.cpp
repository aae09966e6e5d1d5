// Screen, refit, choose, and again; see the header.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <sim/diagnose/naming.hpp>
#include <sim/engine/failure.hpp>

namespace mckibben::diagnose {
namespace {

constexpr std::size_t most_effects = 3, most_refits = 7, most_substitutes = 3, most_firsts = 3;
/// Candidates that change the readings so alike are refitted whatever their score.
constexpr double alike = 0.7;
/// Scores below this share of the best are not worth a refit.
constexpr double least_score = 0.05;
/// Expected drops below this are chance.
constexpr double chance = 6.0;
/// A difference of costs that scatter does not make.
constexpr double clear = 12.0;
/// An effect that closes less of the whole gap than this mends the law of another rather than being one.
constexpr double least_of_all = 0.01;
/// Held-out mean square above the floor at which there is nothing left to find.
constexpr double nothing_left = 0.04;

/// Held-out mean square above the floor at which two effects at once are looked for, and the share of it that
/// they must close.
constexpr double worth_a_pair = 4.0, most_of_it = 0.6;

struct Trial {
  Score score;
  std::size_t place;  ///< among the scores
  Contender contender;
  Improvement gain;
};

std::string title(const Candidate& c) {
  return full_name(c.effect, c.variant);
}

/// A size that a fit has not driven against a bound, nor to nothing.
bool has_size(const Model& model, const Candidate& c) {
  const double value = value_of(model.rig, c.amplitude);
  for (const Parameter& p : model.free) {
    if (p.path != c.amplitude) continue;
    const double edge = 1e-3 * (p.highest - p.lowest);
    const bool at_bound = value > p.highest - edge || (value < p.lowest + edge && c.either_sign);
    return !at_bound && std::abs(value - c.absent) > 1.1 * least_amplitude * std::abs(c.typical);
  }
  return false;
}

/// The model without one of its effects.
Model without(const Model& model, std::size_t effect) {
  Model smaller = model;
  const Candidate& gone = model.effects[effect];
  *find(smaller.rig, gone.amplitude).value = gone.absent;
  std::erase_if(smaller.free,
                [&](const Parameter& p) { return p.path == gone.amplitude || p.path == gone.shape; });
  smaller.effects.erase(smaller.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  return smaller;
}

/// What a screening was made at, and what it found.
struct Screening {
  const Contender* base;
  std::vector<Score> scores;
};

/// Fits a trial with all slopes anew.
void polish(const Case& c, Trial& trial, const std::function<void(const std::string&)>& step) {
  step("fitting " + title(trial.score.candidate));
  auto polished = contend(c, trial.contender.fitted.model);
  if (polished.fitted.failure.empty() && polished.fitted.cost < trial.contender.fitted.cost)
    trial.contender = std::move(polished);
}

/// One candidate more than `base`, fitted with the slopes that `base` has. Look at the fit's failure.
Trial rough(const Case& c, const Contender& base, const Score& score, std::size_t place) {
  const auto known = slopes_of_nominal(base.fitted);
  return {score, place, contend(c, with(c, base.fitted.model, score), &known), {}};
}

/// Nothing left to find, in the runs held out and in those fitted.
bool meets(const Contender& contender) {
  return excess(contender.held_out) < nothing_left && excess(contender.fitted.residuals) < 2.0 * nothing_left;
}

/// Refits of a round: the best of each screening and those like them, roughly first, then in full those that
/// promise. Once one meets the data, only those like it are tried.
std::vector<Trial> refit(const Case& c, const std::vector<Screening>& screenings,
                         const Eigen::VectorXd& reference,
                         const std::function<void(const std::string&)>& step) {
  std::vector<Trial> trials;
  const Score* solved = nullptr;
  const auto wanted = [&](const Score& score, const Score& front) {
    const bool known = std::any_of(trials.begin(), trials.end(), [&](const Trial& t) {
      return t.score.candidate.amplitude == score.candidate.amplitude;
    });
    if (known || trials.size() == most_refits || score.drop < chance) return false;
    if (solved != nullptr) return likeness(score, *solved) > 0.5 * alike;
    return score.drop > least_score * front.drop || likeness(score, front) > alike;
  };
  for (std::size_t place = 0; place < screenings.front().scores.size(); ++place) {
    for (const auto& [base, scores] : screenings) {
      const Score& score = scores[place];
      if (!wanted(score, scores.front())) continue;
      step("trying " + title(score.candidate));
      Trial trial = rough(c, *base, score, place);
      if (!trial.contender.fitted.failure.empty()) continue;
      trials.push_back(std::move(trial));
      if (place > 0) continue;
      polish(c, trials.back(), step);
      if (meets(trials.back().contender)) solved = &score;
    }
  }
  const auto by_cost = [](const Trial& a, const Trial& b) {
    return a.contender.fitted.cost < b.contender.fitted.cost;
  };
  std::stable_sort(trials.begin(), trials.end(), by_cost);
  for (std::size_t i = 0; i < std::min<std::size_t>(trials.size(), 3); ++i) {
    // A rival that the rough fit leaves far behind, or that does not help at all, is not polished.
    const auto rough = compare(c.experiment, reference, trials[i].contender.held_out, c.split.held_out);
    const bool close = trials[i].contender.fitted.cost < 3.0 * trials[0].contender.fitted.cost + 50.0;
    const bool helps = rough.share > 0.02 || excess(reference) < nothing_left;
    if (trials[i].place > 0 && close && helps) polish(c, trials[i], step);
  }
  std::stable_sort(trials.begin(), trials.end(), by_cost);
  for (Trial& trial : trials)
    trial.gain = compare(c.experiment, reference, trial.contender.held_out, c.split.held_out);
  return trials;
}

/// Whether `rival` explains these data as well as `chosen`.
bool as_good(const Case& c, const Contender& chosen, const Contender& rival) {
  const auto worse = compare(c.experiment, rival.held_out, chosen.held_out, c.split.held_out);
  const double costlier = rival.fitted.cost - chosen.fitted.cost;
  return costlier < clear || (worse.gained < 0.05 && costlier < 0.1 * chosen.fitted.cost);
}

Screening screen_at(const Case& c, const Contender& base) {
  // As long as nothing fits, the misfit itself is the scatter: no nominal parameter is worth believing far
  // from its data sheet for the sake of details.
  const double scatter =
      std::max(c.temperature, temperature(c.experiment, base.fitted.residuals, c.split.training));
  return {&base, screen(c.experiment, base.fitted, catalogue(), c.split.training, scatter)};
}

/// Another effect that serves clearly better than the one that `smaller` is without.
std::optional<Trial> substitute(const Case& c, const Contender& smaller, const Candidate& gone,
                                const Contender& best, const std::function<void(const std::string&)>& step) {
  const Screening screening = screen_at(c, smaller);
  for (std::size_t place = 0; place < most_substitutes; ++place) {
    const Score& score = screening.scores[place];
    if (score.drop < chance) break;
    if (score.candidate.effect == gone.effect) continue;
    step(fmt::format("trying {} instead of {}", title(score.candidate), title(gone)));
    Trial trial = rough(c, smaller, score, place);
    if (!trial.contender.fitted.failure.empty()) continue;
    polish(c, trial, step);
    const auto gain = compare(c.experiment, best.held_out, trial.contender.held_out, c.split.held_out);
    if (has_size(trial.contender.fitted.model, score.candidate) && gain.gained > 0.0 &&
        best.fitted.cost - trial.contender.fitted.cost > clear)
      return trial;
  }
  return std::nullopt;
}

/// Two effects that help only together: next to one that fits best but does not convince, another one with
/// which it closes most of the gap.
std::optional<std::array<Trial, 2>> pair_of(const Case& c, const std::vector<Trial>& trials,
                                            const Eigen::VectorXd& before,
                                            const std::function<void(const std::string&)>& step) {
  for (std::size_t i = 0; i < std::min(trials.size(), most_firsts); ++i) {
    const Trial& first = trials[i];
    if (!has_size(first.contender.fitted.model, first.score.candidate)) continue;
    const Screening screening = screen_at(c, first.contender);
    for (std::size_t place = 0; place < most_substitutes; ++place) {
      const Score& score = screening.scores[place];
      if (score.drop < chance) break;
      step(fmt::format("trying {} with {}", title(first.score.candidate), title(score.candidate)));
      Trial second = rough(c, first.contender, score, place);
      if (!second.contender.fitted.failure.empty()) continue;
      const auto closes = [&] {
        second.gain = compare(c.experiment, before, second.contender.held_out, c.split.held_out);
        return second.gain.share;
      };
      if (closes() < 0.5 * most_of_it) continue;
      polish(c, second, step);
      closes();
      const auto beyond =
          compare(c.experiment, first.contender.held_out, second.contender.held_out, c.split.held_out);
      if (has_size(second.contender.fitted.model, score.candidate) &&
          has_size(second.contender.fitted.model, first.score.candidate) && second.gain.share > most_of_it &&
          convinces(second.gain) && convinces(beyond))
        return std::array{first, second};
    }
  }
  return std::nullopt;
}

/// What was taken first may have stood in for what came after it: drops effects that are no longer needed,
/// and swaps those that another one beats now.
void revise(const Case& c, Naming& result, const Eigen::VectorXd& reference,
            const std::function<void(const std::string&)>& step) {
  for (std::size_t i = 0; i + 1 < result.best.fitted.model.effects.size();) {
    const Candidate old = result.best.fitted.model.effects[i];
    step("trying without " + title(old));
    auto smaller = contend(c, without(result.best.fitted.model, i));
    if (!smaller.fitted.failure.empty()) return;
    const auto worse = compare(c.experiment, smaller.held_out, result.best.held_out, c.split.held_out);
    const auto place = result.effects.begin() + static_cast<std::ptrdiff_t>(i);
    const bool needed = convinces(worse) || worse.gained > least_of_all * std::max(excess(reference), 1.0);
    if (!needed) {
      result.best = std::move(smaller);
      result.effects.erase(place);
      if (i == 0) result.rivals.clear();  // they were its rivals
      continue;
    }
    if (!meets(result.best)) {
      if (auto better = substitute(c, smaller, old, result.best, step)) {
        result.best = std::move(better->contender);
        result.effects.erase(place);  // the new one stands last in the model, too
        const Candidate& candidate = better->score.candidate;
        result.effects.push_back({.name = candidate.effect, .variant = candidate.variant});
        if (i == 0) result.rivals.clear();
        continue;
      }
    }
    ++i;
  }
}

}  // namespace

Contender contend(const Case& c, Model model, const KnownSlopes* known) {
  Contender contender;
  contender.fitted =
      fit(c.experiment, std::move(model), c.split.training, {.temperature = c.temperature, .known = known});
  if (!contender.fitted.failure.empty()) return contender;
  try {
    contender.held_out = c.experiment.residuals(contender.fitted.model.rig, c.split.held_out);
  } catch (const engine::NumericalFailure& failure) {
    contender.fitted.failure = failure.what();
  }
  return contender;
}

Model with(const Case& c, const Model& model, const Score& score) {
  const Candidate& candidate = score.candidate;
  Model bigger = model;
  bigger.rig = candidate.chosen(bigger.rig);
  const auto parameters = candidate.parameters(bigger.rig);
  if (!candidate.shape.empty()) *find(bigger.rig, candidate.shape).value = score.shape;
  // The score is a straight line drawn at nothing; the law may bend.
  double least = 0.0, best = candidate.absent;
  for (const double share : {0.1, 0.3, 0.6, 1.0, 1.6}) {
    const double size = std::clamp(candidate.absent + share * (score.amplitude - candidate.absent),
                                   parameters[0].lowest, parameters[0].highest);
    *find(bigger.rig, candidate.amplitude).value = size;
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
  *find(bigger.rig, candidate.amplitude).value = best;
  bigger.free.insert(bigger.free.end(), parameters.begin(), parameters.end());
  bigger.effects.push_back(candidate);
  return bigger;
}

Naming name_effects(const Case& c, const Contender& nominal, const Contender& recalibrated,
                    const Eigen::VectorXd& reference, const std::function<void(const std::string&)>& step) {
  Naming result;
  result.best = recalibrated;
  Eigen::VectorXd before = reference;
  for (int round = 1; round <= static_cast<int>(most_effects); ++round) {
    step("screening");
    // At the rig as described first: the recalibrated one may have bent far to imitate what is missing.
    std::vector<Screening> screenings;
    if (round == 1) screenings.push_back(screen_at(c, nominal));
    screenings.push_back(screen_at(c, result.best));
    const auto& scores = screenings.front().scores;
    if (round == 1) {
      const std::size_t shown = std::min<std::size_t>(8, scores.size());
      for (std::size_t i = 0; i < shown; ++i) {
        result.confusion_names.push_back(title(scores[i].candidate));
        auto& row = result.confusion.emplace_back();
        for (std::size_t j = 0; j < shown; ++j) row.push_back(likeness(scores[i], scores[j]));
      }
    }
    const bool something_left = excess(before) > nothing_left;
    const bool strained =
        screenings.back().scores.front().drop > 15.0;  // priors strained, although the data are met
    std::vector<Trial> trials;
    if (something_left || strained) trials = refit(c, screenings, before, step);
    const Trial* chosen = nullptr;
    for (const Trial& trial : trials) {
      if (!has_size(trial.contender.fitted.model, trial.score.candidate)) continue;
      const bool relieves = !something_left && trial.gain.gained > -0.01 &&
                            result.best.fitted.cost - trial.contender.fitted.cost > clear;
      const bool worthwhile = trial.gain.gained > least_of_all * excess(reference);
      if ((convinces(trial.gain) && worthwhile) || relieves) {
        chosen = &trial;
        break;
      }
    }
    for (const Score& score : scores) {
      Ranked ranked{.name = score.candidate.effect,
                    .variant = score.candidate.variant,
                    .round = round,
                    .score = score.drop,
                    .likeness = likeness(score, scores.front())};
      for (const Trial& trial : trials) {
        if (trial.score.candidate.amplitude != score.candidate.amplitude) continue;
        ranked.refitted = true;
        ranked.training_rmse = c.experiment.rmse(trial.contender.fitted.residuals, c.split.training);
        ranked.held_out_rmse = c.experiment.rmse(trial.contender.held_out, c.split.held_out);
        if (&trial == chosen)
          ranked.outcome = "taken: the best fit, and better on runs held out";
        else if (!has_size(trial.contender.fitted.model, trial.score.candidate))
          ranked.outcome = "its size went to nothing or to a bound";
        else if (chosen != nullptr)
          ranked.outcome =
              as_good(c, chosen->contender, trial.contender) ? "explains the data as well" : "fits less well";
        else
          ranked.outcome = "does not help on runs held out";
      }
      if (!ranked.refitted)
        ranked.outcome = score.drop > 0.0 ? "score too small" : "no influence, or the wrong sign";
      if (ranked.score > 0.0) result.ranking.push_back(ranked);
    }
    if (chosen == nullptr && result.effects.empty() && excess(before) > worth_a_pair) {
      if (auto both = pair_of(c, trials, before, step)) {
        for (const Trial& one : *both)
          result.effects.push_back(
              {.name = one.score.candidate.effect, .variant = one.score.candidate.variant});
        result.best = std::move(both->back().contender);
        revise(c, result, reference, step);
        before = result.best.held_out;
        continue;
      }
    }
    if (chosen == nullptr) break;
    NamedEffect named{.name = chosen->score.candidate.effect, .variant = chosen->score.candidate.variant};
    for (const Trial& rival : trials) {
      const auto& other = rival.score.candidate.effect;
      if (other == named.name || !has_size(rival.contender.fitted.model, rival.score.candidate)) continue;
      if (std::find(named.confusable_with.begin(), named.confusable_with.end(), other) !=
          named.confusable_with.end())
        continue;
      if (!as_good(c, chosen->contender, rival.contender)) continue;
      named.confusable_with.push_back(other);
      if (round == 1) result.rivals.push_back(rival.contender.fitted.model.rig);
    }
    if (round == 1) result.first = chosen->contender.fitted.model.rig;
    result.effects.push_back(std::move(named));
    result.best = chosen->contender;
    revise(c, result, reference, step);
    before = result.best.held_out;
  }
  return result;
}

}  // namespace mckibben::diagnose
