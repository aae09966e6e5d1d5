// See the header.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/data/amount.hpp>
#include <sim/diagnose/story.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/domain/number.hpp>

namespace mckibben::diagnose {

namespace {

std::string capitalised(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

}  // namespace

std::string listed(const std::vector<std::string>& names) {
  if (names.size() < 2) return names.empty() ? "" : names.front();
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::string faults_in_words(const Diagnosis& d) {
  std::string text;
  for (const FaultyRun& faulty : d.faults) {
    text += fmt::format("{}run {}: {}", text.empty() ? "" : "; ", faulty.run, faulty.words);
  }
  if (text.empty()) return text;
  return capitalised(std::move(text)) + ". ";
}

namespace {

std::string sentence_of(const std::string& effect, const plant::Effects& of_rig) {
  std::string text;
  std::apply([&](const auto&... e) { ((effect == e.name ? void(text = e.sentence) : void()), ...); },
             plant::Effects::Table{});
  for (const auto& law : of_rig.laws.list)
    if (effect == law.text->name) text = law.text->sentence;
  return text;
}

std::string amount_in_words(const Diagnosis& d, double value) {
  return data::amount_of(d.gap.judged, value, d.described);
}
std::string what_is_judged(const Diagnosis& d) {
  switch (d.gap.judged) {
    case Judged::force:
      return "the cord's force";
    case Judged::angle:
      return "the joint's angle";
    case Judged::pressure:
      return "the pressure";
    case Judged::contraction:
      break;
  }
  return "the load's height";
}

/// Faults of the bench that the data show, or those whose interval holds 0.
std::string bench_in_words(const Diagnosis& d, bool shown) {
  std::string text;
  for (const BenchFault& fault : d.bench) {
    if (fault.size.holds(0.0) == shown) continue;
    text += shown ? capitalised(fault.words) : "Perhaps " + fault.words;
    if (!fault.write.empty() && fault.write.size() < thresholds.tell.short_line)
      text += fmt::format(" (in the data set: {})", fault.write);
    text += ". ";
  }
  return text;
}

std::string gap_in_words(const Diagnosis& d) {
  const std::string nominal = amount_in_words(d, d.gap.nominal_rmse),
                    corrected = amount_in_words(d, d.gap.corrected_rmse);
  return fmt::format(
      "On runs that the fit has not seen the error of {} {}; the instruments cannot see below {}.",
      what_is_judged(d),
      d.gap.corrected_rmse < d.gap.nominal_rmse
          ? fmt::format("falls from {} to {}", nominal, corrected)
          : fmt::format("is {}, and {} as described", corrected, nominal),
      amount_in_words(d, d.gap.noise_floor));
}

/// Where a valve is of another kind, what gas it passes and what it fills stand for that.
bool is_of_another_valve(const Moved& m) {
  return std::abs(m.deviations) > thresholds.tell.not_credible &&
         (m.fitted.name.ends_with("valve.conductance") || m.fitted.name.ends_with("hose.conductance") ||
          m.fitted.name.ends_with("muscle.dead_volume"));
}

/// Numbers further off than they are stated to be; empty, or sentences and a space.
std::string exceeded_in_words(const Diagnosis& d) {
  const auto deviations = [](const Moved& m) { return m.exceeds() ? std::abs(m.deviations) : 0.0; };
  const auto off = std::ranges::count_if(d.recalibrated, &Moved::exceeds);
  std::string text;
  if (off > 0) {  // the table has all
    const Moved& m = *std::ranges::max_element(d.recalibrated, {}, deviations);
    const double deviation = std::abs((m.fitted.value - m.nominal) / m.deviations);
    text = fmt::format(
        "Further off than the rig file says: {}, by {:.1f} times its ± of {:.2g}{}{}. Measure, "
        "or ask where the values come from. ",
        m.fitted.name, std::abs(m.deviations), deviation, m.fitted.unit == "1" ? "" : " " + m.fitted.unit,
        off == 1 ? "" : fmt::format(", and {} more", off - 1));
  }
  if (std::ranges::any_of(d.recalibrated, is_of_another_valve)) text += "Not credible: is valve.kind right? ";
  if (d.contradicts_sheet) text += "So far off that something else may be missing in their place. ";
  return text;
}

std::string numbers_in_words(const Diagnosis& d) {
  std::string moved;
  for (const Moved& m : d.recalibrated) {
    if (!m.notable()) continue;
    moved += fmt::format("{}{} from {:.4g} to {:.4g}{}", moved.empty() ? "" : ", ", m.fitted.name, m.nominal,
                         m.fitted.value, m.fitted.unit == "1" ? "" : " " + m.fitted.unit);
  }
  return fmt::format("No effect is missing; other values of the rig's parameters explain the gap{}{}. {}{}",
                     moved.empty() ? "" : ": ", moved, exceeded_in_words(d), gap_in_words(d));
}

/// Effects beside general terms.
std::string stand_ins_in_words(const Diagnosis& d) {
  std::vector<std::string> names;
  for (const NamedEffect& effect : d.stand_ins) names.push_back(full_name(effect));
  if (names.empty()) return {};
  return fmt::format(" The corrected rig also has {}: no finding, with something unknown at work.",
                     fmt::join(names, " and "));
}

/// Of which muscle it is, if that is open; what else it may be.
std::string doubts_in_words(const NamedEffect& effect) {
  std::vector<std::string> others;
  std::size_t sides = 0;
  for (const EffectName& rival : effect.confusable_with) {
    if (rival.effect == effect.name) ++sides;
    if (rival.effect != effect.name || effect.side != Side::both) others.push_back(rival.words());
  }
  std::string said;
  if (effect.side == Side::both && sides > 0)
    said = " - of both muscles alike or of one: these data do not decide";
  if (!others.empty())
    said += fmt::format(" - not distinguishable with these data from {}", fmt::join(others, ", "));
  return said;
}

/// Which runs speak for it, by name if they are few, and which against. Each is compared with the same rig
/// without it, whose other numbers are free to stand for it.
std::string support_in_words(const NamedEffect& effect) {
  const Support& s = effect.support;
  if (s.runs == 0) return {};
  if (s.by.empty() && s.against.empty())
    return fmt::format("No run alone separates {} from other values of the rig's parameters. ",
                       effect.who().words());
  const auto ids = [](const std::vector<std::string>& runs) {
    return fmt::format("run{} {}", runs.size() > 1 ? "s" : "", fmt::join(runs, ", "));
  };
  const std::string by = s.by.empty()            ? "No single run"
                         : s.by.size() == s.runs ? fmt::format("All {} runs", s.runs)
                         : s.by.size() > thresholds.tell.few_runs
                             ? fmt::format("{} of {} runs", s.by.size(), s.runs)
                             : ids(s.by);
  std::string said = fmt::format("{} speak{} for {}", by, s.by.size() < 2 ? "s" : "", effect.who().words());
  if (!s.against.empty()) said += fmt::format(", {} against it", ids(s.against));
  return capitalised(std::move(said)) + ". ";
}

/// In what the letters of its terms count (plant/effects/residual_force.hpp); empty if there are none.
std::string counted_in_words(const std::vector<LawTerm>& law) {
  std::vector<std::string_view> said;
  for (const auto& [letter, words] :
       {std::pair{"F ", "F: the braid's force in 100 N"}, std::pair{"P", "P in bar"},
        std::pair{"v", "v in 0.1 m/s"}, std::pair{"m g", "m g in 98 N"}})
    for (const LawTerm& term : law)
      if (term.term.starts_with(letter)) {
        said.emplace_back(words);
        break;
      }
  return said.empty() ? "" : fmt::format(" ({})", fmt::join(said, ", "));
}

/// The largest terms of the law, and how many more there are.
std::string force_in_words(const Diagnosis& d) {
  constexpr std::size_t most = thresholds.tell.most_terms;
  std::vector<LawTerm> terms = d.residual_law;
  std::ranges::stable_sort(terms, std::greater{},
                           [](const LawTerm& term) { return std::abs(term.coefficient.value); });
  const std::size_t more = terms.size() > most ? terms.size() - most : 0;
  if (more == 0) terms = d.residual_law;
  std::string law = d.gap.judged == Judged::angle ? "as a force that shortens each muscle it is "
                                                  : "as a force on the load it is ";
  for (std::size_t i = 0; i + more < terms.size(); ++i) {
    const double force_N = domain::significant(terms[i].coefficient.value, 3);
    if (i > 0) law += force_N < 0.0 ? " - " : " + ";
    law += fmt::format("{} N x {}", i > 0 ? std::abs(force_N) : force_N, terms[i].term);
  }
  if (more > 0) law += fmt::format(" and {} smaller terms", more);
  return law + counted_in_words(d.residual_law);
}

std::string effects_in_words(const Diagnosis& d) {
  std::string said, runs;
  for (const NamedEffect& effect : d.effects) {
    said += fmt::format("{}{} ({})", said.empty() ? "" : ", and ", effect.who().words(),
                        sentence_of(effect.name, d.corrected.effects));
    said += doubts_in_words(effect);
    runs += support_in_words(effect);
  }
  const std::string more =
      d.residual_law.empty() ? "" : "Something else is missing, too: " + force_in_words(d) + ". ";
  return fmt::format("Missing: {}. {}{}{}{}", said, runs, more, exceeded_in_words(d), gap_in_words(d));
}

std::string law_in_words(const Diagnosis& d) {
  if (!d.residual_law.empty())
    return fmt::format("Something is missing that no effect of the catalogue explains; {}. {}",
                       force_in_words(d), gap_in_words(d));
  if (!d.stand_ins.empty())
    return fmt::format("Something real is missing that no effect of the catalogue explains.{} {}{}",
                       stand_ins_in_words(d), exceeded_in_words(d), gap_in_words(d));
  return "Something real is missing, but no effect of the catalogue explains it, and no simple law of "
         "force was found either.";
}

std::string cannot_tell_in_words(const Diagnosis& d) {
  const std::string nearer =
      d.gap.corrected_rmse < d.gap.nominal_rmse ? " " + gap_in_words(d) : std::string();
  if (!d.cannot_tell.empty()) return d.cannot_tell + nearer;
  if (d.ended != Ended::no) return "The search ended before it could decide." + nearer;
  if (d.gap.floors_left() > thresholds.start.explained_floors)
    return "More is left than noise, and nothing that was tried predicts unseen runs clearly better." +
           nearer;
  return "Nothing was found, but these data would not show more than half of the effects of the catalogue at "
         "their usual size, so whether one is missing stays open.";
}

/// Empty if it was through.
std::string search_in_words(const Diagnosis& d) {
  if (d.ended == Ended::no) return {};
  return fmt::format(" The search was ended {} before it was through; not done to the end: {}.",
                     d.ended == Ended::by_user   ? "by you"
                     : d.ended == Ended::by_work ? "after as many simulations as it may make"
                                                 : fmt::format("by its time limit of {:g} s", d.time_limit_s),
                     fmt::join(d.not_done, "; "));
}

/// With what other parameters would leave, where that is less and not by more than chance.
std::string agreement_in_words(const Diagnosis& d) {
  const bool at_floor = d.gap.floors_left() <= thresholds.tell.at_floor;
  const std::string left = amount_in_words(d, d.gap.corrected_rmse),
                    recalibrated = amount_in_words(d, d.gap.recalibrated_rmse);
  return fmt::format(
      "{} to within noise{}: on runs held out {} differs by {}{}, and neither other values of the nominal "
      "parameters nor any effect of the catalogue {}.",
      d.faults.empty() && d.bench.empty() ? "Model and data agree" : "Apart from that model and data agree",
      at_floor ? "" : ", the wander of the input and the ± of the parameters", what_is_judged(d), left,
      at_floor || d.gap.recalibrated_rmse >= d.gap.corrected_rmse
          ? ""
          : fmt::format(" ({} with recalibrated parameters; the instruments cannot see below {})",
                        recalibrated, amount_in_words(d, d.gap.noise_floor)),
      at_floor ? "makes that clearly less" : "predicts these runs better by more than chance");
}

std::string verdict_in_words(const Diagnosis& d) {
  switch (d.verdict) {
    case Verdict::nothing_missing:
      return agreement_in_words(d);
    case Verdict::recalibrate:
      return numbers_in_words(d);
    case Verdict::missing_effect:
      return effects_in_words(d);
    case Verdict::unknown_effect:
      return law_in_words(d);
    case Verdict::cannot_tell:
      break;
  }
  return cannot_tell_in_words(d);
}

}  // namespace

std::string because(const Diagnosis& diagnosis) {
  std::string open = bench_in_words(diagnosis, false);
  if (!open.empty()) open = " " + open.substr(0, open.size() - 1);
  return (diagnosis.ended == Ended::no ? "" : "So far: ") + bench_in_words(diagnosis, true) +
         faults_in_words(diagnosis) + verdict_in_words(diagnosis) + open + search_in_words(diagnosis);
}

}  // namespace mckibben::diagnose
