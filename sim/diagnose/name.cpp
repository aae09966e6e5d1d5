// Screen, refit, choose, and again; see the header.
#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/diagnose/name.hpp>
#include <sim/diagnose/ranking.hpp>
#include <sim/diagnose/revise.hpp>
#include <sim/diagnose/several.hpp>
#include <sim/diagnose/starts.hpp>
#include <sim/diagnose/thresholds.hpp>

namespace mckibben::diagnose {
namespace {

constexpr const NameThresholds& to_name = thresholds.name;

bool cheaper(const Trial& a, const Trial& b) {
  return a.contender.fitted.cost < b.contender.fitted.cost;
}

/// As many as promise at first sight, and those that are polished.
std::size_t most_tries(const std::vector<Screening>& screenings) {
  std::size_t promising = 0;
  for (const Screening& screening : screenings)
    for (const Score& score : screening.scores)
      if (score.drop > to_name.least_score * screening.scores.front().drop) ++promising;
  return std::min(promising, to_name.most_refits) + 1 + to_name.most_polished;
}

bool is_same_law(const Trial& a, const Trial& b) {
  return a.score.candidate.effect == b.score.candidate.effect &&
         a.score.candidate.variant == b.score.candidate.variant;
}

/// How many laws were tried, on whichever side.
std::size_t laws_in(const std::vector<Trial>& trials) {
  std::set<std::pair<std::string, std::string>> laws;
  for (const Trial& one : trials) laws.emplace(one.score.candidate.effect, one.score.candidate.variant);
  return laws.size();
}

/// Whether a fit has left what it tries within its law. Alone, an effect may be named at the edge of its
/// shape; beside others it mends their laws there.
bool is_itself(const Trial& trial) {
  const Model& model = trial.contender.fitted.model;
  return has_size(model, trial.score.candidate) &&
         (model.effects.size() < 2 || has_shape(model, trial.score.candidate));
}

/// Refits of a round: the best of each screening and those like them, roughly first, then in full those that
/// promise. Once one meets the data, only those like it are tried. As long as much is left and none helps,
/// scores have misled, drawn as they are far from where the effect would be: then more are tried.
void refit(const Case& c, const std::string& name, const std::vector<Screening>& screenings,
           const Eigen::VectorXd& reference, const Step& step, std::vector<Trial>& trials) {
  const Score* solved = nullptr;
  bool misled = excess(reference) > to_name.worth_a_pair;
  const auto wanted = [&](const Score& score, const Score& front, double finer) {
    const bool known = std::any_of(trials.begin(), trials.end(), [&](const Trial& t) {
      return t.score.candidate.amplitude == score.candidate.amplitude &&
             t.score.candidate.side == score.candidate.side;
    });
    const bool enough = laws_in(trials) >= to_name.most_refits || finer * score.drop < thresholds.near.chance;
    if (known || !(score.drop > 0.0) || (enough && !misled)) return false;
    if (solved != nullptr) return likeness(score, *solved) > to_name.likeness_solved;
    return score.drop > to_name.least_score * front.drop ||
           likeness(score, front) > to_name.likeness_refitted;
  };
  step(stage(name, most_tries(screenings)));
  for (std::size_t place = 0; place < screenings.front().scores.size(); ++place) {
    for (const auto& [base, scores, finer] : screenings) {
      const Score& score = scores[place];
      if (!wanted(score, scores.front(), finer)) continue;
      step("trying " + title(score.candidate));
      Trial trial = rough(c, *base, score, place);
      if (!trial.contender.fitted.failure.empty()) continue;
      trials.push_back(std::move(trial));
      if (is_itself(trials.back()))
        misled = misled && !convinces(compare(c.experiment, reference, trials.back().contender.held_out,
                                              c.split.held_out));
      if (place > 0) continue;
      polish(c, trials.back(), step);
      if (meets(trials.back().contender)) solved = &score;
    }
  }
  std::stable_sort(trials.begin(), trials.end(), cheaper);
  for (std::size_t i = 0; i < std::min<std::size_t>(trials.size(), to_name.most_polished); ++i) {
    // A rival that the rough fit leaves far behind, or that does not help at all, is not polished.
    const auto rough = compare(c.experiment, reference, trials[i].contender.held_out, c.split.held_out);
    const bool close = trials[i].contender.fitted.cost <
                       to_name.close_factor * trials[0].contender.fitted.cost + to_name.close_cost;
    const bool helps = rough.share > to_name.helps || excess(reference) < thresholds.near.nothing_left;
    if (trials[i].place > 0 && close && helps) polish(c, trials[i], step);
  }
}

/// Of a pair: whose the effect is that fits best, is judged between fits in full.
void fit_all_sides(const Case& c, const std::vector<Screening>& screenings, const Step& step,
                   std::vector<Trial>& trials) {
  if (trials.empty()) return;
  const Trial best = *std::ranges::min_element(trials, cheaper);
  const Side mine = best.score.candidate.side;
  if (mine == Side::both) return;
  for (const Side side : {Side::both, other(mine)}) {
    const auto is_it = [&](const Score& score) {
      return score.candidate.effect == best.score.candidate.effect &&
             score.candidate.variant == best.score.candidate.variant && score.candidate.side == side;
    };
    auto trial = std::ranges::find_if(trials, is_it, &Trial::score);
    for (auto at = screenings.begin(); at != screenings.end() && trial == trials.end(); ++at) {
      const auto score = std::ranges::find_if(at->scores, is_it);
      if (score == at->scores.end()) continue;
      Trial one = rough(c, *at->base, *score, static_cast<std::size_t>(score - at->scores.begin()));
      if (one.contender.fitted.failure.empty()) trial = trials.insert(trials.end(), std::move(one));
    }
    if (trial != trials.end()) polish(c, *trial, step);
  }
}

/// First what fits best, with what it gains.
void judge(const Case& c, const Eigen::VectorXd& reference, std::vector<Trial>& trials) {
  std::stable_sort(trials.begin(), trials.end(), cheaper);
  for (Trial& trial : trials)
    trial.gain = compare(c.experiment, reference, trial.contender.held_out, c.split.held_out);
}

/// Effects whose usual size would change these readings, next to what the free parameters can, by less than
/// a test at 5 % finds as a rule.
std::vector<std::string> invisible(const Case& c, const std::vector<Score>& scores) {
  std::vector<std::string> names;
  for (const Score& score : scores) {
    const Candidate& candidate = score.candidate;
    if (!candidate.fits(c.nominal) || candidate.side != Side::both) continue;
    const double drop = score.column.squaredNorm() * candidate.typical * candidate.typical;
    if (drop < thresholds.screen.visible) names.push_back(title(candidate));
  }
  return names;
}

/// What was named, fitted from the numbers as described as if what is left were scatter: as long as much is,
/// numbers bend far to imitate what is missing. None if nothing speaks for that.
std::optional<Contender> with_straight_numbers(const Case& c, const Contender& best) {
  if (best.fitted.model.effects.empty() || !is_doubtful(c, best)) return std::nullopt;
  Case scattered = c;
  scattered.inflation =
      std::max(c.inflation, variance_inflation(c.experiment, best.fitted.residuals, c.split.training));
  scattered.fitted = {};  // it does not compete
  Contender end = contend(scattered, begun_at(best.fitted.model, c.nominal));
  if (!end.fitted.failure.empty()) return std::nullopt;
  return end;
}

/// First where numbers have not bent to imitate what is missing, if there is such a place.
std::vector<Screening> screenings_of(const Case& c, const Contender* straight, const Contender& best) {
  std::vector<Screening> screenings;
  if (straight != nullptr) screenings.push_back(screen_at(c, *straight));
  screenings.push_back(screen_at(c, best));
  return screenings;
}

/// What a round looks for.
std::string round_in_words(const Naming& result) {
  std::vector<std::string> names;
  for (const NamedEffect& effect : result.effects) names.push_back(full_name(effect));
  return names.empty() ? "effects of the catalogue"
                       : fmt::format("effects beside {}", fmt::join(names, " and "));
}

/// What the first look at the catalogue says: what would not show, and what looks alike.
void tell_first(const Case& c, const std::vector<Screening>& screenings, Naming& result) {
  const auto& scores = screenings.front().scores;
  result.invisible = invisible(c, screenings.back().scores);
  const std::size_t shown = std::min(to_name.shown_alike, scores.size());
  for (std::size_t i = 0; i < shown; ++i) {
    result.confusion_names.push_back(title(scores[i].candidate));
    auto& row = result.confusion.emplace_back();
    for (std::size_t j = 0; j < shown; ++j) row.push_back(likeness(scores[i], scores[j]));
  }
}

/// The best fit of those that convince on the runs held out; with nothing left there, one that relieves
/// strained priors. Beside another effect, one that closes little of the whole gap mends that one's law,
/// unless more than noise is left and it closes nearly all of that; so does one whose shape a fit has driven
/// to a bound. Null if there is none.
const Trial* choose(const std::vector<Trial>& trials, const Contender& best, double left, double whole_gap) {
  for (const Trial& trial : trials) {
    if (!is_itself(trial)) continue;
    const double fall = best.fitted.cost - trial.contender.fitted.cost;
    const bool relieves = left <= thresholds.near.nothing_left && trial.gain.gained > -to_name.relief_loss &&
                          fall > thresholds.near.clear;
    const bool mends_its_own = !trial.score.candidate.adds_to.empty();
    const bool closes_rest = left > to_name.worth_closing && trial.gain.share > to_name.closes_rest &&
                             near_floor(trial.contender.fitted.residuals);
    const double least = to_name.least_of_all * (mends_its_own || closes_rest ? left : whole_gap);
    const bool worthwhile = fall > thresholds.near.chance && trial.gain.gained > least;
    if ((convinces(trial.gain) && worthwhile) || relieves) return &trial;
  }
  return nullptr;
}

/// Of a pair: where neither muscle is ruled out, nor both, both.
const Trial* of_both_if_untold(const Case& c, const std::vector<Trial>& trials, const Trial& best) {
  const Candidate& candidate = best.score.candidate;
  const auto does_as_well = [&](Side side) -> const Trial* {
    for (const Trial& trial : trials)
      if (is_same_law(trial, best) && trial.score.candidate.side == side &&
          has_size(trial.contender.fitted.model, trial.score.candidate) &&
          as_good(c, best.contender, trial.contender))
        return &trial;
    return nullptr;
  };
  if (candidate.side == Side::both) return &best;
  const Trial* both = does_as_well(Side::both);
  if (both == nullptr) return &best;
  const Side rest = other(candidate.side);  // was tried, or both stand for it
  const auto& same = both->score.same;
  const bool untold = std::ranges::find(same, rest) != same.end() || does_as_well(rest) != nullptr;
  return untold ? both : &best;
}

/// How much more misfit the best of the other effects leaves that does not do as well.
double before_rivals(const std::vector<Trial>& trials, const Trial& chosen, const NamedEffect& named) {
  double least = std::numeric_limits<double>::infinity();
  for (const Trial& rival : trials) {
    const EffectName other = rival.score.candidate.who();
    if (other == named.who() ||
        std::ranges::find(named.confusable_with, other) != named.confusable_with.end())
      continue;
    least = std::min(least, rival.contender.fitted.cost - chosen.contender.fitted.cost);
  }
  return least;
}

void take_one(const Case& c, Naming& result, const std::vector<Trial>& trials, const Trial& chosen) {
  NamedEffect named = diagnose::named(chosen.score.candidate);
  for (const Side side : chosen.score.same) named.confusable_with.emplace_back(named.name, side);
  for (const Trial& rival : trials) {
    const EffectName other = rival.score.candidate.who();
    if (other == named.who() || !has_size(rival.contender.fitted.model, rival.score.candidate)) continue;
    if (std::ranges::find(named.confusable_with, other) != named.confusable_with.end()) continue;
    if (!as_good(c, chosen.contender, rival.contender)) continue;
    named.confusable_with.push_back(other);
    result.doubts.push_back({named.who(), other, chosen.contender.fitted, rival.contender.fitted});
  }
  named.support.before_rivals = before_rivals(trials, chosen, named);
  result.effects.push_back(std::move(named));
  result.best = chosen.contender;
}

/// What was named leaves a gap; where nothing was, slow disturbances are no reason.
bool asks_for_several(const Naming& result) {
  return excess(result.best.held_out) >
         (result.effects.empty() ? to_name.worth_a_pair : thresholds.subset.worth_it);
}

/// One effect after the other, several at once where that leaves a gap, and one after the other beside those.
class Namer {
 public:
  Namer(const Case& c, const Contender& nominal, const Contender& recalibrated,
        const Eigen::VectorXd& reference, const AtFault& at_fault, const Step& step, Search& search)
      : c_(c),
        nominal_(nominal),
        recalibrated_(recalibrated),
        reference_(reference),
        at_fault_(at_fault),
        step_(step),
        search_(search) {
    result_.best = recalibrated;
  }

  Naming operator()() {
    if (!name_in_turn() || !name_several()) return std::move(result_);
    drop_uncertain(c_, result_, step_);
    settle(c_, result_);
    return std::move(result_);
  }

 private:
  const Eigen::VectorXd& before() const {
    return result_.effects.empty() ? reference_ : result_.best.held_out;
  }
  std::vector<const Rig*> other_numbers() const {
    return {&nominal_.fitted.model.rig, &recalibrated_.fitted.model.rig};
  }
  bool is_at_fault(More more) {
    bool faulty = false;
    search_.part("faults of runs beside what was found", [&] { faulty = at_fault_(result_.best, more); });
    return faulty;
  }

  /// Rounds, as long as each finds something. False if runs are at fault.
  bool name_in_turn() {
    for (std::size_t more = 0; more < to_name.most_effects && take_next(); ++more)
      if (is_at_fault(More::not_tried)) return false;
    if (!result_.effects.empty())
      search_.part("what was named, from other numbers",
                   [&] { deepen(c_, result_.best, other_numbers(), step_); });
    return true;
  }

  /// A round: false if it finds nothing, or was ended.
  bool take_next() {
    const int round = ++round_;
    const std::string name = fmt::format("naming, round {}", round);
    step_(stage(name));
    step_("screening");
    const double left = excess(before());
    std::vector<Screening> screenings;
    std::vector<Trial> trials;
    std::optional<Contender> straight;
    const bool whole = search_.part(round_in_words(result_), [&] {
      straight = with_straight_numbers(c_, result_.best);
      screenings = round == 1 ? screenings_of(c_, &nominal_, recalibrated_)
                              : screenings_of(c_, straight ? &*straight : nullptr, result_.best);
      if (round == 1) {
        first_ = screenings;
        tell_first(c_, screenings, result_);
      }
      // Priors may be strained although the data are met.
      const bool strained = screenings.back().scores.front().drop > to_name.strained;
      if (left > thresholds.near.nothing_left || strained) {
        refit(c_, name, screenings, before(), step_, trials);
        fit_all_sides(c_, screenings, step_, trials);
        deepen_best(c_, trials, other_numbers(), step_);
        catch_up(c_, trials, step_);
      }
    });
    if (screenings.empty()) return false;
    judge(c_, before(), trials);
    const Trial* chosen = choose(trials, result_.best, left, excess(reference_));
    if (chosen != nullptr) chosen = of_both_if_untold(c_, trials, *chosen);
    const auto judged = ranked(c_, round, screenings, trials, chosen, result_.best);
    result_.ranking.insert(result_.ranking.end(), judged.begin(), judged.end());
    if (chosen != nullptr) {
      c_.learned(fmt::format("taken in round {}: {}", round, title(chosen->score.candidate)));
      take_one(c_, result_, trials, *chosen);
    } else {
      if (!result_.effects.empty() || !(left > to_name.worth_a_pair)) return false;
      bool taken = false;
      search_.part("effects that help only together",
                   [&] { taken = try_pair(c_, result_, trials, before(), step_); });
      if (!taken) return false;
    }
    const bool revised =
        search_.part("whether each effect is needed", [&] { revise(c_, result_, reference_, step_); });
    return whole && revised;
  }

  /// Sets, where a gap is left; what a set leaves may be one effect more. False if runs are at fault.
  bool name_several() {
    if (!asks_for_several(result_)) return true;
    if (!result_.effects.empty() && is_at_fault(More::tried_in_vain)) return false;
    bool taken = false;
    search_.part("several effects at once", [&] {
      std::vector<Screening> bases = std::move(first_);
      const Contender named = result_.best;  // and what more there may be beside the names
      const std::optional<Contender> straight = with_straight_numbers(c_, named);
      if (straight) bases.push_back(screen_at(c_, *straight));
      if (!result_.effects.empty()) bases.push_back(screen_at(c_, named));
      taken = try_several(c_, result_, bases, step_);
      if (taken) revise(c_, result_, reference_, step_);
    });
    return !taken || !asks_for_several(result_) || name_in_turn();
  }

  const Case& c_;
  const Contender &nominal_, &recalibrated_;
  const Eigen::VectorXd& reference_;
  const AtFault& at_fault_;
  const Step& step_;
  Search& search_;
  int round_ = 0;
  std::vector<Screening> first_{};  ///< at the rig as described and as recalibrated
  Naming result_{};
};

}  // namespace

Naming name_effects(const Case& c, const Contender& nominal, const Contender& recalibrated,
                    const Eigen::VectorXd& reference, const AtFault& at_fault, const Step& step,
                    Search& search) {
  return Namer(c, nominal, recalibrated, reference, at_fault, step, search)();
}

}  // namespace mckibben::diagnose
