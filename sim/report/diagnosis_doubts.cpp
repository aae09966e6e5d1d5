// What else it could be, what speaks for each name, what competed; what to measure next.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

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
using diagnose::full_name;
using output::escaped;

/// Runs for and against each name.
std::string support_html(const Diagnosis& diagnosis) {
  std::string rows;
  for (const auto* effects : {&diagnosis.effects, &diagnosis.stand_ins})
    for (const auto& effect : *effects) {
      const auto& support = effect.support;
      const auto runs = [](const std::vector<std::string>& ids) {
        return ids.empty() ? std::string("none") : output::listed(ids);
      };
      rows += row(full_name(effect),
                  {fmt::format("{:.0f}", support.fall),
                   std::isfinite(support.before_rivals) ? fmt::format("{:.0f}", support.before_rivals)
                                                        : std::string("none tried"),
                   runs(support.by), runs(support.against)});
    }
  if (rows.empty()) return "";
  return "<div class='wide' tabindex='0'>" +
         table(
             "Evidence for each name: the fall of the misfit, the larger misfit of the best candidate that "
             "is not equivalent, and runs whose own misfit falls or rises by more than chance",
             {"name", "fall", "next best leaves", "runs for it", "runs against it"}, rows) +
         "</div>\n";
}

/// What competed on the runs held out.
std::string competition_html(const Diagnosis& diagnosis, const plant::Rig& rig) {
  std::string rows;
  for (const auto& one : diagnosis.explanations)
    rows +=
        fmt::format("<tr><th scope='row'>{}</th><td>{:.0f}</td><td>{:.0f}</td><td>{}</td><td>{}</td></tr>\n",
                    escaped(output::explained_by(one)), one.misfit, one.strain,
                    amount_html(one.held_out_rmse, diagnosis.gap.judged, rig),
                    one.chosen    ? "chosen"
                    : one.as_good ? "yes"
                                  : "no");
  if (rows.empty()) return "";
  return folded(
      "What competed",
      paragraph("Every candidate model that was fitted, or the best of its kind. The misfit, -2 log of the "
                "probability, is given above that of the most probable model; a model that is 20 times less "
                "probable has 6 more. The prior penalty is the sum of the squared deviations by which the "
                "rig's parameters moved. If equivalent, parameters are preferred to names, names to a law.") +
          "<div class='wide' tabindex='0'>" +
          table("Candidate models", {"by", "misfit", "prior penalty", "error held out", "equivalent"}, rows) +
          "</div>\n");
}

std::string twins_html(const domain::Dataset& data, const Diagnosis& diagnosis) {
  std::string html;
  for (const auto& effect : diagnosis.effects)
    html += paragraph(
        !std::isfinite(effect.support.before_rivals) && effect.confusable_with.empty()
            ? fmt::format("{}: all others promised less by a linear model, and none was fitted in its "
                          "place.",
                          effect.who().words())
        : effect.confusable_with.empty()
            ? fmt::format("{}: no other effect of the catalogue explains these data as well.",
                          effect.who().words())
            : fmt::format("{} could as well be {}: these data do not separate them.", effect.who().words(),
                          output::listed(words_of(effect.confusable_with))));
  const bool open = !diagnosis.residual_law.empty() ||
                    std::ranges::any_of(diagnosis.effects,
                                        [](const auto& effect) { return !effect.confusable_with.empty(); });
  if (open && !gauged(data) && !data.pressure_is_given())
    html += paragraph(
        "The data hold no muscle pressure. One measured quantity can show one unknown only: what looks like "
        "a missing force could be a missing flow of gas that has the same consequences for the load. A "
        "pressure gauge on the muscle decides it.");
  return html + support_html(diagnosis) + competition_html(diagnosis, data.rig);
}

std::string next_html(const Diagnosis& diagnosis) {
  if (!diagnosis.next_experiment) {
    const std::string words = output::what_next(diagnosis);
    return words.empty() ? "" : paragraph(words);
  }
  const auto& next = *diagnosis.next_experiment;
  return fmt::format(
      "<p><b>{}</b>. It would separate {} with a probability of {:.0f} %. "
      "The option <code>--plan FILE</code> writes it as a campaign.</p>\n",
      escaped(output::in_words(next)), escaped(output::listed(next.separates)), 100.0 * next.expected_power);
}

}  // namespace

std::vector<Chapter> doubts_and_plan(const domain::Dataset& data, const Diagnosis& diagnosis) {
  return {
      {.title = diagnosis.effects.empty() && diagnosis.residual_law.empty() ? "Which candidates look alike"
                                                                            : "What else it could be",
       .html = twins_html(data, diagnosis),
       .on_paper = false},
      {"What to measure next", next_html(diagnosis)}};
}

}  // namespace mckibben::report
