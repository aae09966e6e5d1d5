// The report of `calibrate`: how far samples scatter round the models, and every figure on one page.
#include <fmt/format.h>

#include <sim/output/calibration_report.hpp>
#include <sim/output/chart.hpp>
#include <sim/report/html.hpp>
#include <sim/report/report.hpp>

namespace mckibben::report {
namespace {

using output::spread_text;
using thesis::Direction;

double pressure_spread(const thesis::PressureFit& fit, const thesis::Options& options) {
  const bool joint = options.fitting == thesis::PressureFitting::joint;
  return (joint ? fit.deviation.joint : fit.deviation.in_load) / fit.mean_Pa;
}

struct Scatter {
  std::string friction, pressure;
};
Scatter scatter(const thesis::CalibrationResult& result, const thesis::Options& options,
                Direction direction) {
  return {spread_text(result.friction_of(direction).spread(), 1, " %"),
          spread_text(pressure_spread(result.pressure_of(direction), options), 2, " %")};
}

}  // namespace

std::string report_html(const input::Dataset& dataset, const thesis::CalibrationResult& result,
                        const thesis::Options& options, bool kgf,
                        const std::vector<thesis::Figure>& figures) {
  const auto& grid = result.grid;
  const Scatter up = scatter(result, options, Direction::contraction);
  const Scatter down = scatter(result, options, Direction::relaxation);
  Contents contents{
      .title = "Calibration",
      .about = fmt::format("{}: {} of {} runs used, {} loads from {:g} to {:g} kg", dataset.path.string(),
                           dataset.runs.size() - grid.left_out.size(), dataset.runs.size(),
                           grid.loads_kg.size(), grid.loads_kg.front(), grid.loads_kg.back()),
      .warnings = output::warnings_of(result, options),
      .sentence =
          fmt::format("Samples scatter round the friction model by {} in contraction and {} in relaxation, "
                      "round the pressure model by {} and {} (standard deviation over mean).",
                      up.friction, down.friction, up.pressure, down.pressure),
      .table = fmt::format("<table><caption>Spread: standard deviation over mean</caption>\n<thead><tr><th "
                           "scope='col'>model</th><th scope='col'>contraction</th><th "
                           "scope='col'>relaxation</th></tr></thead>\n<tbody>\n<tr><th scope='row'>friction "
                           "coefficient (T 4.6)</th><td>{}</td><td>{}</td></tr>\n<tr><th "
                           "scope='row'>pressure</th><td>{}</td><td>{}</td></tr>\n</tbody></table>\n",
                           up.friction, down.friction, up.pressure, down.pressure),
      .details = output::report_of(dataset, result, options, kgf),
      .beside =
          "The calibration itself is in calibration.yaml, every number of every fit in calibration.json, the "
          "figures as tables and pictures in figures/."};
  std::vector<Picture> pictures;
  pictures.reserve(figures.size());
  for (const auto& figure : figures)
    pictures.push_back({"", output::chart_svg(figure)});  // which has its title in it
  contents.chapters = {{"Figures", figures_html(pictures)}};
  return html_of(contents);
}

}  // namespace mckibben::report
