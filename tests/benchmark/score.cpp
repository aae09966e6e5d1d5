// See the header.
#include "score.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mckibben::diagnose {

namespace {

using Names = std::set<std::string>;

bool holds(const Names& all, const Names& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

bool is_in(const std::vector<std::string>& list, const std::string& name) {
  return std::ranges::find(list, name) != list.end();
}

/// Whether a simpler explanation does as well as the one that was chosen.
bool simpler_does_as_well(const Diagnosis& found) {
  const auto weight = [](const Explanation& one) { return std::pair(one.kind, one.effects.size()); };
  const auto chosen = std::ranges::find_if(found.explanations, &Explanation::chosen);
  return chosen != found.explanations.end() &&
         std::ranges::any_of(found.explanations, [&](const Explanation& one) {
           return one.as_good && weight(one) < weight(*chosen);
         });
}

/// The name that is meant: nothing in these data tells a late command from a late reading, so either is right
/// if both are told.
std::string meant(const NamedEffect& effect, const Names& truth) {
  const auto told = words_of(effect.confusable_with);
  for (const char* late : {"command_delay", "reading_delay"})
    if (effect.name.ends_with("_delay") && truth.contains(late) && is_in(told, late)) return late;
  return effect.name;
}

void add(Tally& tally, const Coverage& coverage) {
  tally.yes += coverage.inside;
  tally.of += coverage.of;
}

}  // namespace

Answer::Answer(const Hidden& hidden, const Diagnosis& found) {
  const Names truth(hidden.effects.begin(), hidden.effects.end());
  for (const auto& effect : found.effects) {
    named.insert(meant(effect, truth));
    declared.insert(effect.name);
    for (const auto& rival : effect.confusable_with) declared.insert(rival.effect);
    said += (said.empty() ? "" : " + ") + effect.name;
    if (!effect.confusable_with.empty())
      said += fmt::format(" (or {})", fmt::join(words_of(effect.confusable_with), ", "));
  }
  right = named == truth;
  within = holds(declared, truth);
  const bool no_name = found.verdict == Verdict::nothing_missing || found.verdict == Verdict::recalibrate;
  well =
      right && (found.verdict == hidden.verdict || (hidden.verdict == Verdict::nothing_missing && no_name));
  if (hidden.other_law) well = well || (found.verdict == Verdict::unknown_effect && holds(truth, named));
}

void Coverage::count(double truth, const FittedNumber& told) {
  inside += truth >= told.low && truth <= told.high ? 1 : 0;
  ++of;
}

Given::Given(const NamedEffect& effect, const std::vector<std::string>& truth)
    : right(is_in(truth, effect.name)),
      alone(effect.confusable_with.empty()),
      among(right || std::ranges::any_of(effect.confusable_with,
                                         [&](const auto& rival) { return is_in(truth, rival.effect); })),
      margin(std::min(effect.support.fall, effect.support.before_rivals)) {}

Outcome::Outcome(const Hidden& truth, const Diagnosis& diagnosis, const Answer& answer)
    : hidden(truth.verdict),
      found(diagnosis.verdict),
      effects(truth.effects.size()),
      right(answer.right),
      within(answer.within),
      well(answer.well),
      wrong_name(!answer.named.empty() && !holds({truth.effects.begin(), truth.effects.end()}, answer.named)),
      closed(diagnosis.gap.closed >= 0.9),
      other_law(truth.other_law),
      simpler(simpler_does_as_well(diagnosis)) {
  for (const auto& planted : truth.truth)
    for (const auto& effect : diagnosis.effects)
      for (const auto& p : effect.parameters)
        if (planted.path == "effects." + effect.name + "." + p.name) sizes.count(planted.value, p);
  for (const auto& number : truth.numbers)
    for (const auto& moved : diagnosis.recalibrated)
      if (moved.fitted.name == number.path) numbers.count(number.value, moved.fitted);
  for (const auto& effect : diagnosis.effects)
    if (names < given.size()) given[names++] = {effect, truth.effects};
}

void Score::count(const Outcome& outcome) {
  slowest_s_ = std::max(slowest_s_, outcome.took_s);
  wrong_names_.count(outcome.wrong_name);
  well_.count(outcome.well);
  // What a law of no catalogue does to them is not theirs.
  if (outcome.right && outcome.hidden != Verdict::unknown_effect) add(numbers_, outcome.numbers);
  if (outcome.other_law) {
    other_laws_.count(outcome.well);
    return;
  }
  if (outcome.hidden == Verdict::missing_effect) {
    const bool right = outcome.right && outcome.found == Verdict::missing_effect;
    (outcome.effects > 2 ? triples_ : few_).count(right);
    in_set_.count(outcome.within);
    if (outcome.right) closed_.count(outcome.closed);
    if (outcome.right) add(sizes_, outcome.sizes);
  }
  if (outcome.hidden == Verdict::nothing_missing)
    false_alarms_.count(outcome.found == Verdict::missing_effect || outcome.found == Verdict::unknown_effect);
  if (outcome.hidden == Verdict::recalibrate) recalibrated_.count(outcome.found == Verdict::recalibrate);
  if (outcome.hidden == Verdict::unknown_effect) unknown_.count(outcome.found == Verdict::unknown_effect);
  simpler_.count(outcome.simpler);
  advice_.count(outcome.advice);
  for (std::size_t i = 0; i < outcome.names; ++i) given_.push_back(outcome.given.at(i));
}

void Score::print() const {
  few_.print("one or two effects: right names");
  triples_.print("three effects: right names");
  in_set_.print("effects: right name in the declared set");
  closed_.print("effects: gap on held-out runs closed by 90 %");
  sizes_.print("effects: true parameter in its interval");
  numbers_.print("the rig's numbers: true one in its interval");
  recalibrated_.print("changed nominal parameter: recalibrate");
  unknown_.print("unknown laws recognised");
  other_laws_.print("a law of no catalogue: name, or something else");
  false_alarms_.print("nothing hidden: false alarms");
  well_.print("right name or verdict (all data sets)");
  wrong_names_.print("wrong names (all data sets)");
  simpler_.print("a simpler explanation does as well");
  print_reliability();
  advice_.print();
  fmt::print("slowest diagnosis {:.1f} s\n", slowest_s_);
}

void Score::print_reliability() const {
  Tally alone;
  for (const Given& one : given_)
    if (one.alone) alone.count(one.right);
  alone.print("names that no other does as well as: right");
  Tally first, among;
  for (const Given& one : given_) {
    if (!one.alone) first.count(one.right);
    if (!one.alone) among.count(one.among);
  }
  first.print("names beside which others do as well: right");
  among.print("the same: one of them right");
}

}  // namespace mckibben::diagnose
