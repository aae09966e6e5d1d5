// Text and tables of the report; see the header.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <sim/input/number.hpp>
#include <sim/output/diagnosis_figures.hpp>
#include <sim/output/diagnosis_sections.hpp>
#include <sim/output/diagnosis_words.hpp>

namespace mckibben::output {
namespace {

using diagnose::Diagnosis;

std::string row(std::initializer_list<std::string> cells, std::string_view kind = "td") {
  std::string html = "<tr>";
  for (const auto& cell : cells) html += fmt::format("<{0}>{1}</{0}>", kind, cell);
  return html + "</tr>\n";
}

std::string table(const std::string& rows) {
  return "<div class='wide'><table>\n" + rows + "</table></div>\n";
}

std::string estimate_row(const std::string& name, const diagnose::Estimate& fitted) {
  const Readable shown = readable(fitted);
  const std::string exact = fmt::format("{} {}", input::write_number(fitted.value), fitted.unit);
  return row({escaped(name), "<b>" + escaped(shown.value) + "</b>", escaped(shown.interval),
              "<code>" + escaped(exact) + "</code>"});
}

const std::string estimate_head = row({"parameter", "value", "95 % interval", "exact"}, "th");

/// The colour of a mean: orange where the load was measured too high, blue where too low.
std::string shade(double part) {
  return fmt::format("background-color:rgba({},{:.2f})", part > 0.0 ? "213,94,0" : "0,114,178",
                     0.5 * std::min(std::abs(part), 1.0));
}

/// Values of `list` with equal `key`, in the order in which the keys first come.
template <class List, class Key>
auto grouped(const List& list, const Key& key) {
  using Value = typename List::value_type;
  std::vector<std::pair<std::decay_t<decltype(key(list.front()))>, std::vector<const Value*>>> groups;
  for (const Value& value : list) {
    const auto same = [&](const auto& group) { return group.first == key(value); };
    auto at = std::find_if(groups.begin(), groups.end(), same);
    if (at == groups.end()) at = groups.insert(groups.end(), {key(value), {}});
    at->second.push_back(&value);
  }
  return groups;
}

std::string candidate_html(const diagnose::Ranked& one, double most, const plant::Rig& rig) {
  std::string details = fmt::format("score {:.3g} % of the best, likeness to it {:.2f}",
                                    100.0 * one.score / most, one.likeness);
  if (one.refitted) details += fmt::format(", held out {}", height(one.held_out_rmse, rig));
  return fmt::format(
      "<li><b>{}</b><svg class='bar' viewBox='0 0 100 8' preserveAspectRatio='none' aria-hidden='true'>"
      "<rect width='{:.1f}' height='8' class='corrected' fill='currentColor'/></svg>"
      "<span>{}</span><span class='small'>{}</span></li>\n",
      escaped(full_name(one.name, one.variant)), 100.0 * one.score / most, escaped(one.outcome), details);
}

}  // namespace

std::string added_html(const Diagnosis& diagnosis) {
  std::string html;
  for (const auto& effect : diagnosis.effects) {
    const EffectWords words = words_of(effect.name);
    html +=
        fmt::format("<h3>{}</h3>\n<p>{}.</p>\n<p>Law: <code>{}</code></p>\n<p class='small'>Source: {}</p>\n",
                    escaped(full_name(effect.name, effect.variant)), escaped(words.sentence),
                    escaped(words.law), escaped(words.source));
    std::string rows = estimate_head;
    for (const auto& parameter : effect.parameters) rows += estimate_row(parameter.name, parameter);
    html += table(rows);
  }
  if (diagnosis.residual_law.empty()) return html;
  html +=
      "<h3>residual_law</h3>\n<p>A force outside the catalogue, positive upwards: the sum of these terms, "
      "each a coefficient times what it stands for (v in 0.1 m/s, P in bar, m g in 98.0665 N).</p>\n";
  std::string rows = estimate_head;
  for (const auto& term : diagnosis.residual_law) rows += estimate_row(term.term, term.coefficient);
  html += table(rows);
  if (!diagnosis.law_valid_for.empty())
    html += "<p>Valid for " + escaped(diagnosis.law_valid_for) + ".</p>\n";
  return html;
}

std::string recalibrated_html(const Diagnosis& diagnosis) {
  if (diagnosis.recalibrated.empty()) return "";
  std::string rows = row({"parameter", "deviations", "nominal", "fitted", "95 % interval"}, "th");
  for (const auto& moved : diagnosis.recalibrated) {
    const Readable shown = readable(moved.fitted);
    const std::string by = fmt::format("{:+.1f}", moved.deviations);
    rows += row({escaped(moved.fitted.name), std::abs(moved.deviations) > 1.0 ? "<b>" + by + "</b>" : by,
                 escaped(readable(moved.nominal, moved.fitted.unit)), escaped(shown.value),
                 escaped(shown.interval)});
  }
  return "<p>Deviations are those within which a data sheet or a ruler gives the value; more than one is "
         "printed bold.</p>\n" +
         table(rows);
}

std::string where_html(const Diagnosis& diagnosis, const plant::Rig& rig) {
  double most = 0.0;
  for (const auto& cell : diagnosis.where)
    if (cell.rows > 0) most = std::max(most, std::abs(cell.mean));
  std::string html;
  for (const auto& [factor, cells] : grouped(diagnosis.where, [](const auto& cell) { return cell.factor; })) {
    html += fmt::format("<h3>{}</h3>\n<div class='strip'>\n", escaped(factor));
    for (const auto* cell : cells) {
      const std::string name = escaped(cell->cell);
      if (cell->rows == 0)
        html += fmt::format("<div class='empty'><b>{}</b><span>never visited</span></div>\n", name);
      else
        html += fmt::format(
            "<div class='{}' style='{}'><b>{}</b><span>{}{}{}</span><span class='small'>{:.0f} % of the gap"
            "</span></div>\n",
            cell->significant ? "significant" : "", shade(most > 0.0 ? cell->mean / most : 0.0), name,
            cell->mean > 0.0 ? "+" : "", height(cell->mean, rig), cell->significant ? " *" : "",
            100.0 * cell->share_of_gap);
    }
    html += "</div>\n";
  }
  return html;
}

std::string ranking_html(const Diagnosis& diagnosis, const plant::Rig& rig) {
  std::string html;
  for (const auto& [round, all] : grouped(diagnosis.ranking, [](const auto& one) { return one.round; })) {
    double most = 1e-12;
    for (const auto* one : all) most = std::max(most, one->score);
    html += fmt::format("<h3>Round {}</h3>\n<ol class='ranking'>\n", round);
    std::map<std::string, std::vector<std::string>> others;  // by outcome
    for (const auto* one : all) {
      if (one->refitted || one->score >= 0.01 * most)
        html += candidate_html(*one, most, rig);
      else
        others[one->outcome].push_back(full_name(one->name, one->variant));
    }
    html += "</ol>\n";
    for (const auto& [outcome, names] : others)
      html += fmt::format("<p class='small'>{}: {}.</p>\n", escaped(outcome), escaped(listed(names)));
  }
  return html;
}

std::string confusion_html(const Diagnosis& diagnosis) {
  const auto& names = diagnosis.confusion_names;
  if (names.empty()) return "";
  std::string rows = "<tr><th></th>";
  for (std::size_t i = 0; i < names.size(); ++i) rows += fmt::format("<th>{}</th>", i + 1);
  rows += "</tr>\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    rows += fmt::format("<tr><th>{} {}</th>", i + 1, escaped(names[i]));
    for (std::size_t j = 0; j < names.size() && i < diagnosis.confusion.size(); ++j) {
      const double likeness = j < diagnosis.confusion[i].size() ? diagnosis.confusion[i][j] : 0.0;
      const bool twins = i != j && std::abs(likeness) > 0.9;
      rows += fmt::format("<td class='heat{}' style='{}'>{:.2f}</td>", twins ? " significant" : "",
                          shade(std::abs(likeness)), likeness);
    }
    rows += "</tr>\n";
  }
  return table(rows);
}

std::string twins_html(const input::Dataset& data, const Diagnosis& diagnosis) {
  std::string html;
  for (const auto& effect : diagnosis.effects)
    html +=
        effect.confusable_with.empty()
            ? fmt::format("<p><b>{}</b>: no other effect of the catalogue explains these data as well.</p>\n",
                          escaped(effect.name))
            : fmt::format("<p><b>{}</b> could as well be {}: these data cannot tell them apart.</p>\n",
                          escaped(effect.name), escaped(listed(effect.confusable_with)));
  const bool gauge = std::any_of(data.runs.begin(), data.runs.end(),
                                 [](const auto& run) { return run.muscle_pressure_Pa.has_value(); });
  if (!gauge)
    html +=
        "<p>The data hold no muscle pressure. One measured quantity can show one unknown only: what looks "
        "like a missing force could be a missing flow of gas that has the same consequences for the load. A "
        "pressure gauge on the muscle decides it.</p>\n";
  return html;
}

std::string next_html(const Diagnosis& diagnosis) {
  if (!diagnosis.next_experiment) return "";
  const auto& next = *diagnosis.next_experiment;
  return fmt::format(
      "<p><b>{}</b>, with a load of {} kg. It would tell {} apart with a probability of {:.0f} % (test at "
      "5 %).</p>\n<p>The option <code>--plan FILE</code> writes it as a campaign.</p>\n",
      escaped(next.current), input::write_number(next.load_kg), escaped(listed(next.separates)),
      100.0 * next.expected_power);
}

}  // namespace mckibben::output
