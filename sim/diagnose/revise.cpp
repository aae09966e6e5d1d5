// See the header.
#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include <sim/diagnose/interval.hpp>
#include <sim/diagnose/ranking.hpp>
#include <sim/diagnose/revise.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/engine/failure.hpp>

namespace mckibben::diagnose {
namespace {

/// Another effect that serves clearly better than the one that `smaller` is without.
std::optional<Trial> substitute(const Case& c, const Contender& smaller, const Candidate& gone,
                                const Contender& best, const Step& step) {
  const Screening screening = screen_at(c, smaller);
  for (std::size_t place = 0; place < thresholds.name.most_substitutes; ++place) {
    const Score& score = screening.scores[place];
    if (score.drop < thresholds.near.chance) break;
    if (score.candidate.who() == gone.who()) continue;
    step(fmt::format("trying {} instead of {}", title(score.candidate), title(gone)));
    Trial trial = rough(c, smaller, score, place);
    if (!trial.contender.fitted.failure.empty()) continue;
    polish(c, trial, step);
    const auto gain = compare(c.experiment, best.held_out, trial.contender.held_out, c.split.held_out);
    if (has_size(trial.contender.fitted.model, score.candidate) && gain.gained > 0.0 &&
        best.fitted.cost - trial.contender.fitted.cost > thresholds.near.clear)
      return trial;
  }
  return std::nullopt;
}

/// Another law of an effect that does as well as one of two terms, without which `smaller` is.
std::optional<Trial> simpler_law(const Case& c, const Contender& smaller, const Candidate& gone,
                                 const Contender& best, const Step& step) {
  for (const Score& score : screen_at(c, smaller).scores) {
    const Candidate& law = score.candidate;
    if (law.who() != gone.who() || law.variant == gone.variant || !law.adds_to.empty()) continue;
    step(fmt::format("trying {} instead of {}", title(law), title(gone)));
    Trial trial = rough(c, smaller, score, 0);
    if (!trial.contender.fitted.failure.empty()) continue;
    polish(c, trial, step);
    if (has_size(trial.contender.fitted.model, law) && as_good(c, best, trial.contender)) return trial;
  }
  return std::nullopt;
}

}  // namespace

void forget(Naming& result, const Candidate& gone) {
  std::erase_if(result.effects,
                [&](const NamedEffect& effect) { return goes_with(effect.who(), effect.variant, gone); });
  if (gone.adds_to.empty())
    std::erase_if(result.doubts, [&](const Doubt& doubt) { return doubt.effect == gone.who(); });
}

void revise(const Case& c, Naming& result, const Eigen::VectorXd& reference, const Step& step) {
  for (std::size_t i = 0; i + 1 < result.best.fitted.model.effects.size();) {
    const Candidate old = result.best.fitted.model.effects[i];
    step("trying without " + title(old));
    auto smaller = contend(c, without(result.best.fitted.model, i));
    if (!smaller.fitted.failure.empty()) return;
    const auto worse = compare(c.experiment, smaller.held_out, result.best.held_out, c.split.held_out);
    const bool needed =
        convinces(worse) || worse.gained > thresholds.name.least_of_all *
                                               std::max(excess(reference), thresholds.name.least_whole_gap);
    if (!needed) {
      give_up(result.ranking, old, "not needed beside what came later");
      result.best = std::move(smaller);
      forget(result, old);
      continue;
    }
    if (!meets(result.best)) {
      if (auto better = substitute(c, smaller, old, result.best, step)) {
        const Candidate& candidate = better->score.candidate;
        give_up(result.ranking, old, title(candidate) + " serves better");
        take(c, result.ranking, candidate, *better, smaller.fitted.cost - better->contender.fitted.cost,
             "serves better than " + title(old));
        result.best = std::move(better->contender);
        forget(result, old);  // the new one stands last in the model, too
        result.effects.push_back(named(candidate));
        continue;
      }
    }
    ++i;
  }
}

void drop_uncertain(const Case& c, Naming& result, const Step& step) {
  for (std::size_t i = 0; i < result.effects.size();) {
    const Fitted& fitted = result.best.fitted;
    const double inflation = variance_inflation(c.experiment, fitted.residuals, c.split.training);
    const auto bounds =
        intervals(c.experiment, fitted, c.split.training, inflation, thresholds.interval.certain);
    const Candidate candidate = fitted.model.effects[i];
    bool certain = false;
    for (std::size_t j = 0; j < bounds.size(); ++j) {
      const Parameter& p = fitted.model.free[j];
      if (p.path != candidate.amplitude) continue;
      // Towards "absent"; that it may be as large as its law allows is no reason.
      const bool above = bounds[j].value > candidate.absent;
      const double edge = candidate.either_sign ? candidate.absent : above ? p.lowest : p.highest;
      certain = above ? bounds[j].low > edge : bounds[j].high < edge;
    }
    if (certain) {
      ++i;
      continue;
    }
    step("trying without " + title(candidate));
    auto smaller = contend(c, without(fitted.model, i));
    if (!smaller.fitted.failure.empty()) return;
    const char* why = "its 99 % interval reaches nothing";
    const bool has_more = candidate.adds_to.empty() &&
                          std::ranges::count(fitted.model.effects, candidate.who(), &Candidate::who) > 1;
    if (!has_more) {
      give_up(result.ranking, candidate, why);
      result.best = std::move(smaller);
      forget(result, candidate);
      continue;
    }
    auto simpler = simpler_law(c, smaller, candidate, result.best, step);
    if (!simpler) {  // its other term cannot do without it
      ++i;
      continue;
    }
    give_up(result.ranking, candidate, why);
    const Candidate& law = simpler->score.candidate;
    take(c, result.ranking, law, *simpler, smaller.fitted.cost - simpler->contender.fitted.cost,
         "does as well as " + title(candidate));
    forget(result, candidate);
    result.effects.push_back(named(law));
    result.best = std::move(simpler->contender);
  }
}

namespace {

/// What has been named itself is no alternative any more.
void tidy_doubts(Naming& result) {
  const auto named = [&](const EffectName& effect) {
    return std::ranges::find(result.effects, effect, &NamedEffect::who) != result.effects.end();
  };
  for (NamedEffect& effect : result.effects) std::erase_if(effect.confusable_with, named);
  std::erase_if(result.doubts, [&](const Doubt& doubt) { return named(doubt.rival); });
}

/// A law that has got a term more is one effect, under the name of the longer law.
void merge_laws(const Model& model, Naming& result) {
  for (const Candidate& added : model.effects) {
    if (added.adds_to.empty()) continue;
    const auto of_it = [&](const NamedEffect& effect) { return effect.who() == added.who(); };
    const auto first = std::ranges::find_if(result.effects, of_it);
    const auto again = std::find_if(std::next(first), result.effects.end(), of_it);
    if (again == result.effects.end()) continue;  // the rig had the shorter law already
    for (const EffectName& rival : again->confusable_with)
      if (std::ranges::find(first->confusable_with, rival) == first->confusable_with.end())
        first->confusable_with.push_back(rival);
    first->variant = added.variant;
    result.effects.erase(again);
  }
}

/// Sorts by how much worse the runs held out are without each effect, everything else as it is.
void sort_by_importance(const Case& c, Naming& result) {
  std::vector<std::pair<EffectName, double>> left;
  const Model& model = result.best.fitted.model;
  for (std::size_t i = 0; i < result.effects.size(); ++i) {
    double squares = std::numeric_limits<double>::infinity();
    try {
      squares = c.experiment.residuals(without(model, i).rig, c.split.held_out).squaredNorm();
    } catch (const engine::NumericalFailure&) {
      // What cannot even be simulated without it matters most.
    }
    left.emplace_back(result.effects[i].who(), squares);
  }
  const auto first = [&](const EffectName& a, const EffectName& b) {
    const auto of = [&](const EffectName& effect) {
      return std::find_if(left.begin(), left.end(), [&](const auto& l) { return l.first == effect; })->second;
    };
    return of(a) > of(b);
  };
  std::stable_sort(result.effects.begin(), result.effects.end(),
                   [&](const auto& a, const auto& b) { return first(a.who(), b.who()); });
  std::stable_sort(result.doubts.begin(), result.doubts.end(),
                   [&](const Doubt& a, const Doubt& b) { return first(*a.effect, *b.effect); });
}

}  // namespace

void settle(const Case& c, Naming& result) {
  tidy_doubts(result);
  sort_by_importance(c, result);
  merge_laws(result.best.fitted.model, result);
}

}  // namespace mckibben::diagnose
