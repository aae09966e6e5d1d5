// The report of `calibrate`: which models are good and which are not, what each figure shows, and behind
// that the figures.
#include <charconv>

#include <fmt/format.h>

#include <sim/output/calibration_report.hpp>
#include <sim/output/svg.hpp>
#include <sim/report/html.hpp>
#include <sim/report/report.hpp>
#include <sim/thesis/quality.hpp>

namespace mckibben::report {
namespace {

using thesis::Quality;
using Models = std::array<Quality, 4>;

/// Figures 4.`first` to 4.`last` of the thesis, what they show, and how it looks if all is well.
struct Kind {
  int first, last;
  const char *title, *says;
};
constexpr Kind kinds[] = {
    {18, 26, "Friction coefficient, as calibrated (T 4.6)",
     "Each dot is a row of the measurements: the friction force that is left when the braid's force lifts "
     "the load, over the force that presses the threads together. The line is the model that goes into "
     "calibration.yaml. Good: the line runs through the middle of the cloud at every speed; the width of the "
     "cloud is the spread. 4.19 is the part that depends on the current's speed: good if the dots lie along "
     "the line. 4.26 is the spread speed by speed: a high dot calls for a look at the runs of that speed."},
    {27, 34, "Pressure of one load (T 4.7 to 4.13)",
     "Which pressure holds the load at a contraction. Good: line and dots lie on each other. 4.28 shows "
     "whether pressure shifts with load and speed in an orderly way. 4.29 to 4.32 are coefficients against "
     "the current's speed, 4.33 and 4.34 the distance from the model: good if low at every speed."},
    {35, 49, "Pressure coefficients against load (T 4.14 to 4.28)",
     "Every coefficient of the pressure model over the loads: dots by the thesis's sequence of fits, curves "
     "by that and by fitting all samples at once. Curves that part, or dots all over the place, mean that "
     "the data do not settle this coefficient by itself. That is no harm between the calibrated loads as "
     "long as the spread of the pressure above is good: only the sum is used."},
    {2, 17, "Friction models that are not used (T 4.4, T 4.5)",
     "The thesis tries two others first, drawn here for comparison. "
     "Nothing in calibration.yaml comes from them."}};

int number_of(const thesis::Figure& figure) {
  int number = 0;
  if (figure.number.size() > 2)  // "4.2"
    std::from_chars(figure.number.data() + 2, figure.number.data() + figure.number.size(), number);
  return number;
}

std::string figures_of(const std::vector<thesis::Figure>& figures) {
  std::string html;
  for (const Kind& kind : kinds) {
    std::vector<Picture> pictures;
    for (const auto& figure : figures)
      if (kind.first <= number_of(figure) && number_of(figure) <= kind.last)
        pictures.push_back({"", output::chart_svg(figure)});  // which has its title in it
    if (pictures.empty()) continue;
    html += fmt::format("<h3>{}</h3>\n<p>{}</p>\n<details><summary>{} figure{}</summary>\n{}</details>\n",
                        kind.title, kind.says, pictures.size(), pictures.size() == 1 ? "" : "s",
                        figures_html(pictures));
  }
  return html;
}

const char* word(Quality::Grade grade) {
  return grade == Quality::Grade::good ? "good" : grade == Quality::Grade::rough ? "rough" : "not usable";
}

/// "Good: pressure in contraction (5.6 %). Rough: ..."
std::string sentence(const Models& models) {
  using enum Quality::Grade;
  std::string text;
  for (const auto grade : {good, rough, not_usable}) {
    std::string names;
    for (const auto& model : models)
      if (model.grade() == grade)
        names +=
            fmt::format("{}{} ({})", names.empty() ? "" : ", ", model.name(),
                        grade == not_usable ? "above 100 %" : output::spread_text(model.spread, 1, " %"));
    std::string head = word(grade);
    head[0] = static_cast<char>(head[0] - 'a' + 'A');
    if (!names.empty()) text += fmt::format("{}{}: {}.", text.empty() ? "" : " ", head, names);
  }
  return text;
}

std::string table(const Models& models) {
  std::string html =
      "<table class='says'><caption>How far the samples scatter round each model: standard deviation over "
      "mean</caption>\n<thead><tr><th scope='col'>model</th><th scope='col'>spread</th><th "
      "scope='col'>thesis</th><th scope='col'>what that means</th></tr></thead>\n<tbody>\n";
  for (const auto& model : models)
    html += fmt::format("<tr><th scope='row'>{}</th><td>{}</td><td>below {:g} %</td><td>{}</td></tr>\n",
                        model.name(), output::spread_text(model.spread, 1, " %"),
                        100.0 * model.printed_spread(), output::escaped(model.meaning()));
  return html + "</tbody></table>\n";
}

}  // namespace

std::string report_html(const domain::Dataset& dataset, const thesis::CalibrationResult& result,
                        const thesis::Options& options, bool kgf,
                        const std::vector<thesis::Figure>& figures) {
  const auto& grid = result.grid;
  const Models models = thesis::quality_of(result, options);
  Contents contents{
      .title = "Calibration",
      .about = fmt::format("{}: {} of {} runs used, {} loads from {:g} to {:g} kg", dataset.path.string(),
                           dataset.runs.size() - grid.left_out.size(), dataset.runs.size(),
                           grid.loads_kg.size(), grid.loads_kg.front(), grid.loads_kg.back()),
      .warnings = output::warnings_of(result, options),
      .sentence = sentence(models),
      .table = table(models),
      .details = output::report_of(dataset, result, options, kgf),
      .beside =
          "The calibration itself is in calibration.yaml, every number of every fit in calibration.json, the "
          "figures as tables and pictures in figures/.",
      .lengths = false};
  contents.chapters = {{"What each figure shows", figures_of(figures)}};
  return html_of(contents);
}

}  // namespace mckibben::report
