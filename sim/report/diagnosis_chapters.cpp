// Words, tables and where the pictures go; see the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/diagnose/remaining.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/input/field_kinds.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/diagnosis_chapters.hpp>
#include <sim/report/diagnosis_pictures.hpp>
#include <sim/report/html.hpp>
#include <sim/report/length.hpp>
#include <sim/report/tables.hpp>

namespace mckibben::report {
namespace {

using diagnose::Diagnosis;
using diagnose::FittedNumber;
using diagnose::full_name;
using output::escaped;
using output::readable;
using output::rounded;

std::string found_row(const std::string& of, const std::string& name, const FittedNumber& fitted) {
  const auto shown = readable(fitted);
  return row(of, {name, shown.value, shown.interval});
}

/// What was added; or else what was recalibrated by more than a data sheet promises.
std::string found(const Diagnosis& diagnosis) {
  std::string rows;
  for (const auto& fault : diagnosis.bench) {
    const auto shown = readable(fault, diagnosis.described);
    rows += row(fault.name, {fault.words, shown.value, shown.interval});
  }
  std::string marks;
  for (const auto& effect : diagnosis.effects) {
    const std::string others = output::or_others_line(effect);
    for (const auto& parameter : effect.parameters)
      rows += found_row(full_name(effect) + (others.empty() ? "" : " *"), parameter.name, parameter);
    if (!others.empty()) marks += paragraph(others);
  }
  for (const auto& effect : diagnosis.stand_ins)
    for (const auto& parameter : effect.parameters)
      rows += found_row(full_name(effect) + " (fits, no finding)", parameter.name, parameter);
  for (const auto& term : diagnosis.residual_law)
    rows += found_row("residual_law", term.term, term.coefficient);
  if (rows.empty())
    for (const auto& moved : diagnosis.recalibrated)
      if (std::abs(moved.deviations) > 1.0)
        rows += found_row("recalibrated", moved.fitted.name, moved.fitted);
  const std::string verdict = fmt::format("Verdict: {}", plant::name_of(diagnosis.verdict));
  if (rows.empty()) return "<p><b>" + escaped(verdict) + "</b></p>\n";
  return "<div>" + table(verdict, {"found", "parameter", "value", "95 % interval"}, rows) + marks +
         "</div>\n";
}

/// What to write in the data set where the bench is at fault.
std::string lines_that_mend(const Diagnosis& diagnosis) {
  std::string rows;
  for (const auto& fault : diagnosis.bench)
    rows += row(fault.name, {output::listed(fault.runs), fault.write});
  return rows.empty() ? "" : table("Mended in the data set by", {"fault", "runs", "line"}, rows);
}

std::string gap_row(const char* name, double rmse, const diagnose::Gap& gap, const plant::Rig& rig) {
  const std::string floors = gap.noise_floor > 0.0 ? fmt::format("{:.{}f} \u00d7", rmse / gap.noise_floor,
                                                                 rmse < 10.0 * gap.noise_floor ? 1 : 0)
                                                   : "-";
  return fmt::format("<tr><th scope='row'>{}</th><td>{}</td><td>{}</td></tr>\n", name,
                     amount_html(rmse, gap.judged, rig), floors);
}

/// The model whose gap the map shows.
const char* before_additions(const Diagnosis& diagnosis) {
  return diagnosis.gap.nominal_is_nearer() ? "nominal" : "recalibrated";
}

/// Where much of the gap sits in little of the data, in a sentence; empty if it is spread evenly.
std::string concentration(const Diagnosis& diagnosis, const plant::Rig& rig) {
  if (std::min(diagnosis.gap.nominal_rmse, diagnosis.gap.recalibrated_rmse) <
      diagnose::thresholds.tell.at_floor * diagnosis.gap.noise_floor)
    return paragraph(fmt::format("Nothing is left here: the {} model is as near as the noise floor.",
                                 before_additions(diagnosis)));
  const auto dense = diagnose::densest(diagnosis.where);
  if (dense.empty()) return "";
  const diagnose::Cell& most = dense.front().cell;
  return fmt::format("<p>It is concentrated at {} {}: {:.0f} % of the gap in {:.0f} % of the time.</p>\n",
                     escaped(most.factor), cell_html(most, rig), 100.0 * most.share_of_gap,
                     100.0 * dense.front().share_of_time);
}

/// "height", "force", "angle".
std::string name_of(diagnose::Judged judged) {
  return judged == diagnose::Judged::contraction ? "height" : std::string(plant::name_of(judged));
}

std::string where_html(const Diagnosis& diagnosis, const plant::Rig& rig) {
  if (diagnosis.where.empty()) return "";
  const output::JudgedWords& judged = output::words_of(diagnosis.gap.judged);
  return paragraph(fmt::format(
             "Measured less {} model, before anything was added, as {}, averaged "
             "over parts of the data. Orange: {} than the model says; blue: {}. Framed "
             "and marked with *: the mean of this part differs from the mean over all parts of its picture "
             "(where there is only one, from 0) by more than chance; of all marks {:g} % may be false. "
             "Dashed: the data never went there, so nothing is known of it.",
             before_additions(diagnosis), judged.what, judged.more, judged.less,
             100.0 * diagnose::thresholds.where.false_discoveries)) +
         concentration(diagnosis, rig) + figures_html(where_pictures(diagnosis, rig));
}

std::string ranking_html(const Diagnosis& diagnosis, const plant::Rig& rig) {
  if (diagnosis.ranking.empty()) return "";
  return paragraph(
             "Misfit is -2 log of the probability of the data; 6 less are strong evidence. Dashed bars: by "
             "how much a linear model promises that it falls with a candidate, beyond what the rig's "
             "parameters can imitate; a candidate that would have to act the wrong way round has none. The "
             "most promising are fitted. Full bars: by how much the misfit fell from that of the fitted "
             "parameters, with the outcome and the error on the runs held out. Left of the dashed line a "
             "fall is chance. All bars have one logarithmic scale.") +
         figures_html(ranking_pictures(diagnosis, rig));
}

std::string law_html(const Diagnosis& diagnosis, const plant::Rig& rig) {
  if (diagnosis.residual_law.empty()) return "";
  const bool pair = diagnosis.gap.judged == diagnose::Judged::angle;
  std::string html = "<h3>residual_law</h3>\n" +
                     paragraph(fmt::format(
                         "A force outside the catalogue, {}: the sum of the terms above, each a coefficient "
                         "times what it stands for (x {}, v its speed in 0.1 m/s, "
                         "P in bar, m g in 98.0665 N).",
                         pair ? "that shortens each muscle" : "positive upwards",
                         pair ? "by how much the muscle is shorter" : "rise of the load"));
  if (!diagnosis.law_valid_for.empty())
    html += "<p>" + text_html("Valid for " + diagnosis.law_valid_for + ".", rig) + "</p>\n";
  return html;
}

std::string recalibrated_html(const Diagnosis& diagnosis) {
  if (diagnosis.recalibrated.empty()) return "";
  std::string rows;
  double most = 0.0;
  for (const auto& moved : diagnosis.recalibrated) {
    most = std::max(most, std::abs(moved.deviations));
    if (!moved.notable()) continue;
    const auto shown = readable(moved.fitted);
    rows += row(moved.fitted.name, {readable(moved.nominal, moved.fitted.unit), shown.value, shown.interval,
                                    rounded(moved.deviations, 1, true)});
  }
  if (rows.empty())
    return paragraph(fmt::format("Recalibrated: no parameter moved by more than {} deviations of its ±.",
                                 rounded(most, 1)));
  return "<div class='wide' tabindex='0'>" +
         table(
             "Recalibrated by a deviation or more, of those within which a data sheet or a ruler gives the "
             "value",
             {"parameter", "nominal", "fitted", "95 % interval", "deviations"}, rows) +
         "</div>\n";
}

std::string left_open_html(const Diagnosis& diagnosis) {
  if (diagnosis.left_open.empty()) return "";
  std::string items;
  for (const auto& open : diagnosis.left_open) items += "<li>" + escaped(open.words) + "</li>\n";
  return "<h3>Not identifiable from these data</h3>\n" +
         paragraph(
             "The readings add little to what was known of these. The corrected rig has the values nearest "
             "to "
             "its description; others along the same line explain the data equally well.") +
         "<ul>\n" + items + "</ul>\n";
}

std::string absorbed_html(const Diagnosis& diagnosis) {
  if (diagnosis.effects.empty() && diagnosis.stand_ins.empty() && diagnosis.residual_law.empty()) return "";
  if (diagnosis.absorbed.empty()) return "";
  return "<div class='on-screen'><h3>What the numbers had absorbed</h3>\n" +
         paragraph(
             "A nominal parameter that is wrong in the right way imitates a missing effect. With the effect "
             "in the model it should return towards 0.") +
         "<p class='keys'><span class='c3'><svg viewBox='0 0 34 10' aria-hidden='true'><path class='bar' "
         "d='M0 1H34V9H0Z'/></svg>without what was added</span><span class='c0'><svg viewBox='0 0 34 10' "
         "aria-hidden='true'><path class='bar' d='M0 1H34V9H0Z'/></svg>with it</span></p>\n" +
         figures_html({{"How far each was moved, in deviations as above.", absorbed_svg(diagnosis)}}) +
         "</div>\n";
}

std::string added_html(const Diagnosis& diagnosis, const plant::Rig& rig) {
  std::string html;
  const auto add = [&](const diagnose::NamedEffect& effect) {
    const auto words = output::words_of(effect.name, diagnosis.corrected.effects);
    std::string says(words.sentence);
    if (!says.empty() && says[0] >= 'a' && says[0] <= 'z') says[0] = static_cast<char>(says[0] - 'a' + 'A');
    const std::string others = output::or_others(effect);
    const std::string name = full_name(effect) + (others.empty() ? "" : " " + others);
    html += fmt::format("<h3>{}</h3>\n<p>{}.<br>Law: <code>{}</code><br><span class='small'>{}</span></p>\n",
                        escaped(name), escaped(says), escaped(words.law), escaped(words.source));
    if (effect.stands_in) html += paragraph("No finding: something outside the catalogue is missing.");
  };
  for (const auto& effect : diagnosis.effects) add(effect);
  for (const auto& effect : diagnosis.stand_ins) add(effect);
  return html + law_html(diagnosis, rig) + recalibrated_html(diagnosis) + left_open_html(diagnosis) +
         absorbed_html(diagnosis);
}

/// Errors that are left, by load.
std::string loads_html(const std::vector<const diagnose::RunGap*>& runs, bool changed,
                       const plant::Rig& rig) {
  std::vector<RunError> judged;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (const double rmse = left_of(*runs[i], changed); std::isfinite(rmse) && !runs[i]->left_out)
      judged.push_back({runs[i]->id, runs[i]->load_kg, rmse, i});
  return paragraph(changed ? "What is left with the corrected rig:" : "What is left once recalibrated:") +
         by_load_html(judged, rig);
}

std::string gap_html(const Diagnosis& diagnosis, const std::vector<const diagnose::RunGap*>& runs,
                     const plant::Rig& rig) {
  if (runs.empty()) return "";
  const bool changed = output::changed(diagnosis);
  const std::string picture =
      figures_html({{fmt::format("Root mean square error of {}, run by run.", name_of(diagnosis.gap.judged)),
                     errors_svg(runs, diagnosis.gap, changed, rig)}});
  return fmt::format(
             "<p>Nominal is the rig as it was described, recalibrated has its numbers fitted and nothing "
             "added{}. No fit has seen the runs held out: they decide. The axis is logarithmic.<span "
             "class='live-only'> A click on a run leads to its plots.</span></p>\n",
             changed ? ", corrected has what was found" : "") +
         (runs.size() > many_runs
              ? (diagnosis.gap.judged == diagnose::Judged::contraction ? loads_html(runs, changed, rig)
                                                                       : "") +
                    folded(fmt::format("All {} runs", runs.size()), picture)
              : picture);
}

/// Errors of what was read beside.
std::string beside_html(const diagnose::Gap& gap) {
  std::string rows;
  for (const auto& one : gap.beside)
    rows += row(one.reading, {readable(one.nominal_rmse, one.unit), readable(one.recalibrated_rmse, one.unit),
                              readable(one.corrected_rmse, one.unit), readable(one.noise_floor, one.unit)});
  if (rows.empty()) return "";
  return table("The same of the auxiliary readings, each with its own noise floor.",
               {"reading", "nominal", "recalibrated", "corrected", "noise floor"}, rows);
}

}  // namespace

bool gauged(const domain::Dataset& data) {
  return std::any_of(data.runs.begin(), data.runs.end(),
                     [](const auto& run) { return run.find("muscle_pressure") != nullptr; });
}

double left_of(const diagnose::RunGap& run, bool changed) {
  return changed ? run.corrected_rmse : run.recalibrated_rmse;
}

std::string result_table(const domain::Dataset& data, const Diagnosis& diagnosis) {
  const auto& gap = diagnosis.gap;
  const auto unseen = output::held_out(diagnosis);
  std::string html = "<div class='tables'>\n" + found(diagnosis) + lines_that_mend(diagnosis);
  if (unseen.empty()) return html + "</div>\n";
  const bool few = unseen.size() <= 6;
  const std::string on = output::each_is_held_out(diagnosis) ? "runs, each predicted from the others"
                         : few ? "runs held out (" + output::listed(unseen) + ")"
                               : fmt::format("{} runs held out", unseen.size());
  std::string caption = fmt::format("Error of {} on the {}, root mean square.", name_of(gap.judged), on);
  std::string rows = gap_row("nominal", gap.nominal_rmse, gap, data.rig) +
                     gap_row("recalibrated", gap.recalibrated_rmse, gap, data.rig);
  if (output::changed(diagnosis)) {
    caption += fmt::format(" Of its square above the noise floor {:.1f} % is gone.", 100.0 * gap.closed);
    rows += gap_row("corrected", gap.corrected_rmse, gap, data.rig);
  }
  rows += fmt::format("<tr><th scope='row'>noise floor</th><td>{}</td><td></td></tr>\n",
                      amount_html(gap.noise_floor, gap.judged, data.rig));
  html += "<div>" + table(caption, {"rig", "error", "over floor"}, rows) + beside_html(gap);
  if (const std::string why = output::why_recalibrated_is_worse(diagnosis); !why.empty())
    html += paragraph(why);
  if (!few && !output::each_is_held_out(diagnosis))
    html += folded("Which runs are held out", paragraph(output::listed(unseen)));
  return html + "</div></div>\n";
}

std::vector<Chapter> story(const domain::Dataset& data, const Diagnosis& diagnosis,
                           const std::vector<const diagnose::RunGap*>& runs) {
  const plant::Rig& rig = data.rig;
  return {{.title = "Where they disagree", .html = where_html(diagnosis, rig), .on_paper = false},
          {.title = diagnosis.effects.empty() ? "What was tried" : "What explains it",
           .html = ranking_html(diagnosis, rig),
           .on_paper = false},
          {diagnosis.effects.empty() && diagnosis.stand_ins.empty() && diagnosis.residual_law.empty()
               ? "What was changed"
               : "What was added",
           added_html(diagnosis, rig)},
          {output::changed(diagnosis) ? "How far the gap shrank" : "The gap, run by run",
           gap_html(diagnosis, runs, rig)}};
}

}  // namespace mckibben::report
