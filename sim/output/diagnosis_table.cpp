// Layout of the text; see the header.
#include <algorithm>

#include <fmt/format.h>

#include <sim/data/amount.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/input/field_kinds.hpp>
#include <sim/output/diagnosis_results.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/grid.hpp>

namespace mckibben::output {
namespace {

using diagnose::Diagnosis;

constexpr std::size_t most_others = 3;  // explanations that do as well, in the text

std::string warnings(const Diagnosis& diagnosis) {
  std::string text = diagnosis.warnings.empty() ? "" : "\n";
  for (const auto& warning : diagnosis.warnings) text += fmt::format("warning: {}\n", warning);
  return text;
}

std::string bench(const Diagnosis& diagnosis) {
  Grid grid({"fault", "runs", "size", "95 % interval", "in the data set"}, 5);
  for (const auto& fault : diagnosis.bench) {
    const Readable shown = readable(fault, diagnosis.described);
    grid.add({fault.name, fault.runs.size() == diagnosis.runs.size() ? "all" : listed(fault.runs),
              shown.value, shown.interval, fault.write});
  }
  return grid.empty() ? "" : grid.text();
}

std::string added(const Diagnosis& diagnosis) {
  Grid grid({"effect", "parameter", "value", "95 % interval"}, 4);
  const auto add = [&](const std::string& effect, const std::string& name,
                       const diagnose::FittedNumber& fitted) {
    const Readable shown = readable(fitted);
    grid.add({effect, name, shown.value, shown.interval});
  };
  std::string marks;
  for (const auto& effect : diagnosis.effects) {
    const std::string others = or_others_line(effect);
    for (const auto& parameter : effect.parameters)
      add(full_name(effect) + (others.empty() ? "" : " *"), parameter.name, parameter);
    if (!others.empty()) marks += "  " + others + "\n";
  }
  for (const auto& effect : diagnosis.stand_ins)
    for (const auto& parameter : effect.parameters)
      add(full_name(effect) + " (fits, no finding)", parameter.name, parameter);
  for (const auto& term : diagnosis.residual_law) {
    add("residual_law", term.term, term.coefficient);
    for (const auto& shape : term.shape) add("", shape.name, shape);
  }
  return grid.empty() ? "" : grid.text() + marks;
}

std::string moved(const Diagnosis& diagnosis) {
  Grid grid({"parameter", "nominal", "fitted", "95 % interval", "deviations"}, 4);
  for (const auto& one : diagnosis.recalibrated) {
    if (!one.notable()) continue;
    const Readable shown = readable(one.fitted);
    grid.add({one.fitted.name, readable(one.nominal, one.fitted.unit), shown.value, shown.interval,
              rounded(one.deviations, 1, true)});
  }
  return grid.empty() ? "" : grid.text();
}

std::string gap(const Diagnosis& diagnosis, const plant::Rig& rig) {
  const auto& gap = diagnosis.gap;
  Grid grid({"nominal", "recalibrated", "corrected", "noise floor", "closed"}, 0);
  const data::Shown in = data::shown_in(gap.judged, rig);
  const auto error = [&](double value) { return fmt::format("{:.{}f}", value / in.size, in.decimals); };
  grid.add({error(gap.nominal_rmse), error(gap.recalibrated_rmse), error(gap.corrected_rmse),
            error(gap.noise_floor), changed(diagnosis) ? fmt::format("{:.1f} %", 100.0 * gap.closed) : "-"});
  const std::string why = why_recalibrated_is_worse(diagnosis);
  return grid.text() + (why.empty() ? "" : "  " + why + "\n");
}

std::string beside(const Diagnosis& diagnosis) {
  Grid grid({"reading", "nominal", "recalibrated", "corrected", "noise floor"}, 1);
  for (const auto& one : diagnosis.gap.beside) {
    const auto error = [&](double value) { return readable(value, one.unit); };
    grid.add({one.reading, error(one.nominal_rmse), error(one.recalibrated_rmse), error(one.corrected_rmse),
              error(one.noise_floor)});
  }
  return grid.empty() ? "" : grid.text();
}

std::string twins(const Diagnosis& diagnosis) {
  std::string text;
  std::size_t others = 0;
  for (const auto& one : diagnosis.explanations)
    if (one.as_good && !one.chosen && ++others <= most_others)
      text += fmt::format("  {}\n", explained_as_well_by(diagnosis, one));
  if (others > most_others)
    text += fmt::format("  and {} more: explanations in diagnosis.json\n", others - most_others);
  return text;
}

std::string next(const Diagnosis& diagnosis) {
  if (!diagnosis.next_experiment) {
    const std::string words = is_unexplained(diagnosis) ? what_next(diagnosis) : left_undecided(diagnosis);
    return words.empty() ? "" : "  " + words + "\n";
  }
  const auto& next = *diagnosis.next_experiment;
  return fmt::format("  {}: separates {} with a probability of {:.0f} %\n", in_words(next),
                     listed(next.separates), 100.0 * next.expected_power);
}

}  // namespace

std::string table_of(const domain::Dataset& data, const Diagnosis& diagnosis) {
  const auto unseen = held_out(diagnosis);
  std::string text = fmt::format("{}: {}, {}; errors are {}\n", data.path.string(), runs_in_words(data),
                                 held_out_in_words(diagnosis), words_of(data.judged()).errors);
  text += warnings(diagnosis);
  text += fmt::format("\n{}: {}\n", plant::name_of(diagnosis.verdict), title_of(diagnosis));
  if (!diagnosis.because.empty()) text += diagnosis.because + "\n";
  text += section("faults of the bench, no effects of the rig", bench(diagnosis));
  text += section("added to the rig", added(diagnosis));
  if (!diagnosis.residual_law.empty() && !diagnosis.law_valid_for.empty())
    text += "  residual_law is valid for " + diagnosis.law_valid_for + "\n";
  text += section("recalibrated by more than a deviation of what a data sheet promises", moved(diagnosis));
  if (!unseen.empty()) text += section("rmse of the runs held out", gap(diagnosis, data.rig));
  text += section("rmse of the other readings, each weighted by its own noise floor", beside(diagnosis));
  const bool undecided = std::ranges::none_of(diagnosis.explanations, &diagnose::Explanation::chosen);
  text += section(undecided ? "closest to these data" : "explain these data as well", twins(diagnosis));
  return text + section("to measure next", next(diagnosis));
}

}  // namespace mckibben::output
