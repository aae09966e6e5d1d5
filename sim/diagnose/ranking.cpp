// See the header.
#include <algorithm>

#include <fmt/format.h>

#include <sim/diagnose/ranking.hpp>

namespace mckibben::diagnose {
namespace {

constexpr std::string_view taken = "taken: ";

bool is(const Ranked& one, const Candidate& candidate) {
  return one.name == candidate.effect && one.variant == candidate.variant && one.side == candidate.side;
}

void tell_fit(const Case& c, const Trial& trial, Ranked& one) {
  one.refitted = true;
  one.training_rmse = c.experiment.rmse(trial.contender.fitted.residuals, c.split.training);
  one.held_out_rmse = c.experiment.rmse(trial.contender.held_out, c.split.held_out);
}

std::string outcome_of(const Case& c, const Trial& trial, const Trial* chosen) {
  if (&trial == chosen) return std::string(taken) + "the best fit, and better on runs held out";
  if (!has_size(trial.contender.fitted.model, trial.score.candidate))
    return "its size went to nothing or to a bound";
  if (trial.contender.fitted.model.effects.size() > 1 &&
      !has_shape(trial.contender.fitted.model, trial.score.candidate))
    return "its shape went to a bound: it mends the law of what is named";
  if (chosen != nullptr)
    return as_good(c, chosen->contender, trial.contender) ? "explains the data as well" : "fits less well";
  if (trial.gain.gained > 0.0) return "helps too little on runs held out";
  return "does not help on runs held out";
}

}  // namespace

std::vector<Ranked> ranked(const Case& c, int round, const std::vector<Screening>& screenings,
                           const std::vector<Trial>& trials, const Trial* chosen, const Contender& base) {
  const auto& front = screenings.front().scores.front();
  std::vector<Ranked> list;
  for (const Score& score : screenings.front().scores) {
    Ranked one{.name = score.candidate.effect,
               .variant = score.candidate.variant,
               .round = round,
               .score = score.drop,
               .likeness = likeness(score, front),
               .side = score.candidate.side};
    // Whichever screening promised more was the reason to try it.
    for (const Screening& screening : screenings)
      for (const Score& other : screening.scores)
        if (is(one, other.candidate)) one.score = std::max(one.score, other.drop);
    for (const Trial& trial : trials) {
      if (!is(one, trial.score.candidate)) continue;
      tell_fit(c, trial, one);
      one.fall = base.fitted.cost - trial.contender.fitted.cost;
      one.outcome = outcome_of(c, trial, chosen);
    }
    if (!one.refitted)
      one.outcome = one.score <= 0.0 ? "no influence, or the wrong sign"
                    : chosen != nullptr && meets(chosen->contender)
                        ? "not tried: with the one taken nothing is left to explain"
                        : "score too small";
    if (one.score > 0.0) list.push_back(std::move(one));
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Ranked& a, const Ranked& b) { return a.score > b.score; });
  return list;
}

void take(const Case& c, std::vector<Ranked>& ranking, const Candidate& candidate, const Trial& trial,
          double fall, const std::string& why) {
  const int round = ranking.back().round;
  const auto at = std::find_if(ranking.begin(), ranking.end(),
                               [&](const Ranked& one) { return one.round == round && is(one, candidate); });
  Ranked& one = at != ranking.end() ? *at
                                    : ranking.emplace_back(Ranked{.name = candidate.effect,
                                                                  .variant = candidate.variant,
                                                                  .round = round,
                                                                  .side = candidate.side});
  tell_fit(c, trial, one);
  if (is(one, trial.score.candidate)) one.score = std::max(one.score, trial.score.drop);
  one.fall = fall;
  one.outcome = std::string(taken) + why;
}

void give_up(std::vector<Ranked>& ranking, const Candidate& candidate, const std::string& why) {
  for (Ranked& one : ranking)
    if (is(one, candidate) && one.outcome.starts_with(taken)) one.outcome = "given up: " + why;
}

void disown(std::vector<Ranked>& ranking, const NamedEffect& stand_in) {
  for (Ranked& one : ranking)
    if (full_name(one) == full_name(stand_in) && one.outcome.starts_with(taken))
      one.outcome = "stands in for something else: not the same everywhere";
}

void disown(std::vector<Ranked>& ranking) {
  for (Ranked& one : ranking)
    if (one.outcome.starts_with(taken)) one.outcome = "comes nearest, but leaves too much to be named";
}

}  // namespace mckibben::diagnose
