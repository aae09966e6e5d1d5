// See the header.
#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/diagnose/ranking.hpp>
#include <sim/diagnose/several.hpp>
#include <sim/diagnose/subsets.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

std::string words_of(const Subset& subset) {
  std::vector<std::string> names;
  for (const Score& score : subset.members) names.push_back(title(score.candidate));
  return fmt::format("{}", fmt::join(names, " with "));
}

bool is_named(const Naming& naming, const Subset& subset) {
  return subset.members.size() == naming.effects.size() &&
         std::ranges::all_of(subset.members, [&](const Score& score) {
           return std::ranges::find(naming.effects, score.candidate.who(), &NamedEffect::who) !=
                  naming.effects.end();
         });
}

/// The base with all members, those that the fit drives to nothing or to a bound taken out again; a shape at
/// its edge belongs to another law.
std::optional<Contender> fitted(const Case& c, const Contender& base, const Subset& subset) {
  Model model = base.fitted.model;
  for (const Score& score : subset.members) model = with(c, model, score);
  Contender contender = contend(c, std::move(model));
  for (;;) {
    if (!contender.fitted.failure.empty()) return std::nullopt;
    const Model& now = contender.fitted.model;
    const auto gone = std::ranges::find_if_not(
        now.effects, [&](const Candidate& one) { return has_size(now, one) && has_shape(now, one); });
    if (gone == now.effects.end()) return contender;
    if (now.effects.size() < 2) return std::nullopt;
    contender = contend(c, without(now, static_cast<std::size_t>(gone - now.effects.begin())));
  }
}

/// Two effects that help only together: next to one that fits best but does not convince, another one with
/// which it closes most of the gap.
std::optional<std::array<Trial, 2>> pair_of(const Case& c, const std::vector<Trial>& trials,
                                            const Eigen::VectorXd& before, const Step& step) {
  for (std::size_t i = 0; i < std::min(trials.size(), thresholds.name.most_firsts); ++i) {
    const Trial& first = trials[i];
    if (!has_size(first.contender.fitted.model, first.score.candidate)) continue;
    const Screening screening = screen_at(c, first.contender);
    for (std::size_t place = 0; place < thresholds.name.most_substitutes; ++place) {
      const Score& score = screening.scores[place];
      if (score.drop < thresholds.near.chance) break;
      step(fmt::format("trying {} with {}", title(first.score.candidate), title(score.candidate)));
      Trial second = rough(c, first.contender, score, place);
      if (!second.contender.fitted.failure.empty()) continue;
      const auto closes = [&] {
        second.gain = compare(c.experiment, before, second.contender.held_out, c.split.held_out);
        return second.gain.share;
      };
      if (closes() < thresholds.name.rough_pair_share) continue;
      polish(c, second, step);
      closes();
      const auto beyond =
          compare(c.experiment, first.contender.held_out, second.contender.held_out, c.split.held_out);
      if (has_size(second.contender.fitted.model, score.candidate) &&
          has_size(second.contender.fitted.model, first.score.candidate) &&
          second.gain.share > thresholds.name.pair_share && convinces(second.gain) && convinces(beyond))
        return std::array{first, second};
    }
  }
  return std::nullopt;
}

void take_both(const Case& c, Naming& result, std::array<Trial, 2> both) {
  const double fall = result.best.fitted.cost - both.back().contender.fitted.cost;
  for (const Trial& one : both) {
    const Candidate& candidate = one.score.candidate;
    const Trial& other = both.at(&one == &both.front() ? 1 : 0);
    take(c, result.ranking, candidate, both.back(), fall,
         fmt::format("with {} it closes most of the gap", title(other.score.candidate)));
    result.effects.push_back(named(candidate));
  }
  result.best = std::move(both.back().contender);
}

}  // namespace

bool try_several(const Case& c, Naming& result, std::span<const Screening> screenings, const Step& step) {
  std::vector<std::pair<const Contender*, Subset>> sets;
  for (const Screening& screening : screenings)
    for (Subset& subset : best_subsets(screening.scores))
      if (!is_named(result, subset)) sets.emplace_back(screening.base, std::move(subset));
  step(stage("several effects at once", sets.size()));
  std::optional<Contender> best;
  for (const auto& [base, subset] : sets) {
    step("trying " + words_of(subset));
    auto contender = fitted(c, *base, subset);
    if (!contender || contender->fitted.model.effects.size() < 2) continue;
    if (!best || contender->fitted.cost < best->fitted.cost) best = std::move(contender);
    if (meets(*best)) break;
  }
  if (!best) return false;
  const auto gain = compare(c.experiment, result.best.held_out, best->held_out, c.split.held_out);
  const double fall = result.best.fitted.cost - best->fitted.cost;
  if (!convinces(gain) || gain.share < thresholds.subset.share || fall < thresholds.near.clear) return false;
  for (const Candidate& old : result.best.fitted.model.effects)
    give_up(result.ranking, old, "several others together serve better");
  result.effects.clear();
  result.doubts.clear();
  Trial all;
  all.contender = *best;
  for (const Candidate& candidate : best->fitted.model.effects) {
    take(c, result.ranking, candidate, all, fall, "of several that close most of the gap together");
    result.effects.push_back(named(candidate));
  }
  result.best = std::move(*best);
  return true;
}

bool try_pair(const Case& c, Naming& result, const std::vector<Trial>& trials, const Eigen::VectorXd& before,
              const Step& step) {
  auto both = pair_of(c, trials, before, step);
  if (both) take_both(c, result, std::move(*both));
  return both.has_value();
}

}  // namespace mckibben::diagnose
