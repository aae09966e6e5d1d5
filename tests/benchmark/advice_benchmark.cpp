// See the header.
#include "advice_benchmark.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include <fmt/ranges.h>

#include "whole.hpp"

namespace mckibben::diagnose {
namespace {

bool names_are_right(const Diagnosis& found, const Hidden& hidden) {
  std::set<std::string> names;
  for (const NamedEffect& effect : found.effects) names.insert(effect.name);
  return names == std::set<std::string>(hidden.effects.begin(), hidden.effects.end());
}

/// "a (or b, c) + d".
std::string names_of(const Diagnosis& found) {
  std::vector<std::string> names;
  for (const NamedEffect& effect : found.effects)
    names.push_back(
        effect.confusable_with.empty()
            ? effect.name
            : fmt::format("{} (or {})", effect.name, fmt::join(words_of(effect.confusable_with), ", ")));
  return names.empty() ? "no name" : fmt::format("{}", fmt::join(names, " + "));
}

bool is_open(const NamedEffect& effect) {
  return !effect.confusable_with.empty();
}

}  // namespace

Advice follow(const Hidden& hidden, const Diagnosis& found, const Asked& asked, std::string& words) {
  Advice advice{.open = found.next_experiment || std::ranges::any_of(found.effects, is_open)};
  if (!advice.open) return advice;
  advice.right_before = names_are_right(found, hidden);
  if (!found.next_experiment) {
    words = "      nothing of the menu would tell\n";
    return advice;
  }
  const NextExperiment& next = *found.next_experiment;
  advice.asked = true;
  advice.power = next.expected_power;
  Hidden more = hidden;
  more.data.runs.push_back(measured_as(next, hidden));
  const Diagnosis again = whole_diagnosis(more.data, asked);
  advice.right = names_are_right(again, hidden);
  const auto still_as_good = [&](const NamedEffect& effect) {
    return std::ranges::any_of(words_of(effect.confusable_with), [&](const std::string& rival) {
      return std::ranges::find(next.separates, rival) != next.separates.end();
    });
  };
  advice.settled = advice.right && std::ranges::none_of(again.effects, still_as_good);
  words = fmt::format("      {}, {:.3g} kg, {:.0f} % to tell {}: {}{}\n", next.waveform, next.load_kg,
                      100.0 * next.expected_power, fmt::join(next.separates, " from "), names_of(again),
                      advice.settled ? "" : "  OPEN");
  return advice;
}

void AdviceScore::count(const Advice& advice) {
  if (!advice.open) return;
  asked_.count(advice.asked);
  if (!advice.asked) return;
  right_before_.count(advice.right_before);
  right_.count(advice.right);
  settled_.count(advice.settled);
  promised_ += advice.power;
}

void AdviceScore::print() const {
  asked_.print("a name is open: a measurement is proposed");
  right_before_.print("of these names right before it");
  right_.print("names right with it");
  settled_.print("doubt resolved");
  if (settled_.of > 0) fmt::print("{:<48} {:6.1f}\n", "doubts resolved, as promised", promised_);
}

}  // namespace mckibben::diagnose
