// The page: its style, its order, and the sentences round the pictures.
#include <initializer_list>
#include <utility>

#include <fmt/format.h>

#include <sim/output/diagnosis_figures.hpp>
#include <sim/output/diagnosis_report.hpp>
#include <sim/output/diagnosis_sections.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/output/svg.hpp>

namespace mckibben::output {
namespace {

using diagnose::Diagnosis;

/// {0} blue, {1} vermilion, {2} purple; of a dark page {3} sky, {4} orange.
std::string style() {
  constexpr const char* variables =
      ":root{{color-scheme:light "
      "dark;--ground:#fff;--ink:#1a1a1a;--soft:#5c5c5c;--line:#d9d9d9;--card:#f5f5f3;"
      "--measured:#8a8a8a;--noise:#e2e2e2;--nominal:{1};--recalibrated:{2};--corrected:{0}}}\n"
      "@media screen and (prefers-color-scheme:dark){{:root{{--ground:#161616;--ink:#ececec;--soft:#a8a8a8;"
      "--line:#3a3a3a;--card:#222;--measured:#9a9a9a;--noise:#333;--nominal:{4};--corrected:{3}}}}}\n";
  constexpr const char* rules =
      "body{margin:0 auto;padding:1rem;max-width:62rem;background:var(--ground);color:var(--ink);"
      "font:1rem/1.5 system-ui,sans-serif;print-color-adjust:exact;-webkit-print-color-adjust:exact}\n"
      "h1{font-size:1.6rem;line-height:1.2;overflow-wrap:anywhere}\n"
      "h2{margin-top:2.2rem;border-bottom:1px solid var(--line);font-size:1.25rem}\n"
      "h3{margin-bottom:.3rem;font-size:1rem}\n"
      "p,li{max-width:44rem}\n"
      ".small{font-size:.85rem;color:var(--soft)}\n"
      ".lead{font-size:1.15rem}\n"
      ".warning{padding:.5rem .8rem;border-left:.4rem solid var(--nominal);background:var(--card)}\n"
      "code{font-size:.9em;overflow-wrap:anywhere}\n"
      "figure{margin:1rem 0;break-inside:avoid}\n"
      "figure svg{display:block;width:100%;max-width:36rem;height:auto;font:13px system-ui,sans-serif}\n"
      "figcaption{font-size:.9rem;color:var(--soft)}\n"
      ".runs{display:grid;gap:1rem;grid-template-columns:repeat(auto-fit,minmax(min(100%,24rem),1fr))}\n"
      ".runs figure{margin:0}\n"
      "svg text{fill:var(--ink)}svg text.small{font-size:11.5px;fill:var(--soft)}svg text.strong{font-weight:"
      "600}\n"
      ".nominal{color:var(--nominal)}.recalibrated{color:var(--recalibrated)}.corrected{color:var(--"
      "corrected)}"
      ".measured{color:var(--measured)}.noise{color:var(--noise)}\n"
      ".line{fill:none;stroke:currentColor;stroke-width:1.3;stroke-linejoin:round}"
      ".line.measured{stroke-width:3.5}.dashed{stroke-dasharray:5 3}\n"
      ".grid{stroke:var(--line)}.axis{stroke:var(--soft)}.floor{stroke:var(--ink);stroke-dasharray:4 3}\n"
      ".key{display:flex;flex-wrap:wrap;gap:.2rem 1.2rem;padding:0;list-style:none;font-size:.9rem}\n"
      ".key b{display:inline-block;width:1.4rem;height:.55rem;margin-right:.4rem;background:currentColor}\n"
      ".key span{color:var(--ink)}\n"
      ".wide{overflow-x:auto}\n"
      "table{border-collapse:collapse;font-size:.9rem}\n"
      "th,td{padding:.25rem .6rem;border-bottom:1px solid var(--line);text-align:left;vertical-align:top}\n"
      "th{font-weight:600}td.heat{text-align:center}\n"
      ".strip{display:grid;gap:3px;grid-template-columns:repeat(auto-fit,minmax(6.2rem,1fr));break-inside:"
      "avoid}\n"
      ".strip div{display:flex;flex-direction:column;padding:.3rem .4rem;border:2px solid transparent;"
      "font-size:.85rem;line-height:1.3}\n"
      ".strip .small{color:var(--ink)}\n"
      ".strip .significant,td.significant{border:2px solid var(--ink)}\n"
      ".strip .empty{color:var(--soft);background:repeating-linear-gradient(45deg,transparent 0 5px,"
      "var(--line) 5px 6px)}\n"
      ".ranking{padding-left:1.6rem}.ranking li{margin-bottom:.6rem;break-inside:avoid}\n"
      ".ranking span{display:block}.ranking "
      ".bar{display:block;width:100%;height:8px;background:var(--card)}\n"
      "@media (max-width:30rem){th,td{padding:.25rem .3rem}}\n"
      "@media print{body{max-width:none}}\n";
  return "<style>\n" + fmt::format(variables, colours[0], colours[1], colours[3], colours[5], colours[4]) +
         rules + "</style>\n";
}

std::string key(std::initializer_list<std::pair<const char*, const char*>> entries) {
  std::string html = "<ul class='key'>";
  for (const auto& [kind, says] : entries)
    html += fmt::format("<li class='{}'><b></b><span>{}</span></li>", kind, says);
  return html + "</ul>\n";
}

/// A headed part of the page; nothing if it has no contents.
std::string part(const char* title, const std::string& says, const std::string& contents) {
  if (contents.empty()) return "";
  return fmt::format("<h2>{}</h2>\n{}{}", title, says.empty() ? "" : "<p>" + says + "</p>\n", contents);
}

std::string figure(const std::string& svg, const std::string& caption) {
  return fmt::format("<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n", svg, escaped(caption));
}

std::string warnings(const Diagnosis& diagnosis) {
  std::string html;
  for (const auto& warning : diagnosis.warnings)
    html += "<p class='warning'><b>Warning:</b> " + escaped(warning) + "</p>\n";
  return html;
}

std::string gap(const Diagnosis& diagnosis, const plant::Rig& rig) {
  const auto unseen = held_out(diagnosis);
  std::string html = key({{"nominal", "nominal: the rig as it was described"},
                          {"recalibrated", "recalibrated: its numbers fitted, nothing added"},
                          {"corrected", "corrected: with what was found"}});
  if (!unseen.empty())
    html += figure(gap_svg(diagnosis, rig),
                   fmt::format("Root mean square error of the load's height on the runs that no fit has seen "
                               "({}). {:.1f} % of the mean square above the noise floor is gone.",
                               listed(unseen), 100.0 * diagnosis.gap.closed));
  if (!diagnosis.runs.empty())
    html += figure(runs_svg(diagnosis, rig), "The same for each run: nominal \u2192 corrected.");
  return html;
}

std::string curves(const Diagnosis& diagnosis, const plant::Rig& rig) {
  std::string html;
  for (const auto& run : diagnosis.runs)
    if (run.held_out && !run.measured.empty())
      html += figure(run_svg(run, diagnosis.gap.noise_floor, rig),
                     fmt::format("{}, {:g} kg", run.id, run.load_kg));
  if (html.empty()) return "";
  return key({{"measured", "measured"}, {"nominal", "nominal"}, {"corrected", "corrected"}}) +
         "<div class='runs'>\n" + html + "</div>\n";
}

std::string absorbed(const Diagnosis& diagnosis) {
  if (diagnosis.absorbed.empty()) return "";
  return key({{"recalibrated", "without the effects"}, {"corrected", "with them"}}) +
         figure(absorbed_svg(diagnosis), "How far each nominal parameter was moved, in prior deviations.");
}

std::string colophon(const input::Dataset& data, const Diagnosis& diagnosis) {
  std::string html = fmt::format(
      "<p class='small'>Heights are heights of the load: 0.001 of contraction ratio is {:g} mm. The noise "
      "floor is what counting and jitter of the encoder let nobody see, or what equal runs differ by. The "
      "thresholds aim at naming an effect where none is missing in {:.0f} % of data sets. Seed {}; mckibben "
      "{}. Exact numbers are in diagnosis.json, the rig in rig.yaml.</p>\n",
      data.rig.muscle.rest_length_m, 100.0 * diagnosis.false_alarm_rate, diagnosis.seed, MCKIBBEN_VERSION);
  return html;
}

}  // namespace

std::string report_html(const input::Dataset& data, const Diagnosis& diagnosis) {
  const plant::Rig& rig = data.rig;
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n"
      "<meta name='viewport' content='width=device-width,initial-scale=1'>\n<title>{} - {}</title>\n",
      escaped(title_of(diagnosis)), escaped(name_of(data)));
  html += style() + "</head>\n<body>\n";
  html += fmt::format("<p class='small'>Diagnosis of {}, {} runs</p>\n", escaped(name_of(data)),
                      diagnosis.runs.size());
  html += warnings(diagnosis);
  html += fmt::format("<h1>{}</h1>\n<p class='lead'>{}</p>\n", escaped(title_of(diagnosis)),
                      escaped(diagnosis.because));
  html += part("The gap", "", gap(diagnosis, rig));
  html += part("Runs that no fit has seen", "Above: the motion. Below: what the models do not explain of it.",
               curves(diagnosis, rig));
  html += part("What was added", "", added_html(diagnosis));
  html += part("What was recalibrated", "", recalibrated_html(diagnosis));
  html += part(
      "Where they disagree",
      "Measured less recalibrated model, before anything was added, in parts of the data. Orange: the load "
      "was higher than the model says; blue: lower. Framed and marked with *: more than chance (false "
      "discoveries 5 %). Hatched: the data never went there, so nothing is known of it.",
      where_html(diagnosis, rig));
  html += part(
      "Candidates",
      "The score is how much of the disagreement an effect could explain that the nominal parameters cannot "
      "imitate; bars compare it with the best of its round. The best are fitted, and judged on runs held "
      "out.",
      ranking_html(diagnosis, rig));
  html += part(
      "Which can be taken for which",
      "Likeness of what two candidates change in these data: at 1 they look the same, above 0.9 (framed) "
      "they cannot be told apart, at 0 they have nothing in common.",
      confusion_html(diagnosis));
  html += part(
      "What the numbers had absorbed",
      "A nominal parameter that is wrong in the right way imitates a missing effect. With the effect in the "
      "model it should return towards 0.",
      absorbed(diagnosis));
  html += part("What else it could be", "", twins_html(data, diagnosis));
  html += part("What to measure next", "", next_html(diagnosis));
  return html + colophon(data, diagnosis) + "</body>\n</html>\n";
}

}  // namespace mckibben::output
