// The verb `calibrate`: a data set's friction and pressure models, with all figures of the thesis.
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/calibration_file.hpp>
#include <sim/output/calibration_report.hpp>
#include <sim/output/diagnosis_words.hpp>
#include <sim/report/report.hpp>
#include <sim/run/batch.hpp>
#include <sim/tasks/tasks.hpp>
#include <sim/thesis/calibrate.hpp>
#include <sim/thesis/figures.hpp>

namespace mckibben::cli {
namespace {

struct CalibrateOptions : Options {
  std::string dataset, rig;  ///< rig: empty for the data set's
  thesis::Options fits;
  bool kgf = false;  ///< pressures of figures and report in kgf/m2
};

template <class T>
void add_choice(CLI::App& verb, const char* name, T& value, const std::map<std::string, T>& choices,
                const char* help) {
  std::vector<std::string> words;
  words.reserve(choices.size());
  for (const auto& choice : choices) words.push_back(choice.first);
  const auto choose = [&value, choices](const std::string& text) { value = choices.at(text); };
  verb.add_option_function<std::string>(name, choose, help)->check(one_of("choice", words))->type_name("");
}

int calibrate_dataset(const CalibrateOptions& options) {
  const domain::Dataset dataset = tasks::ticked(
      tasks::read_measured(options.dataset, options.rig, tasks::replace_rig), options.fits.orders, say);
  Job job(options, "calibrate " + options.dataset, output::name_of(dataset) + "-calibrate", dataset.inputs);
  const thesis::CalibrationResult result = thesis::calibrate(dataset, options.fits);
  if (run::interrupted()) throw run::Interrupted();
  warn(output::warnings_of(result, options.fits));

  const std::string document = output::json_of(dataset, result, options.fits);
  const std::string report = output::report_of(dataset, result, options.fits, options.kgf);
  std::string spreads = "# Spread (standard deviation over mean) of the samples round each model:\n";
  for (const auto& line : output::meanings_of(result, options.fits)) spreads += "#   " + line + "\n";
  job.write("calibration.yaml", spreads + input::calibration_yaml(result.calibration));
  job.write("calibration.json", document);
  job.write("report.txt", report);
  const auto figures = thesis::figures(result, options.kgf);
  job.write("report.html", report::report_html(dataset, result, options.fits, options.kgf, figures));
  for (const thesis::Figure& figure : figures) {
    job.write("figures/" + figure.file_name() + ".csv", output::csv_of(figure));
    job.write("figures/" + figure.file_name() + ".svg", output::chart_svg(figure));
  }
  const std::string written = (job.where() / "calibration.yaml").string();
  const std::string next = fmt::format(
      "map {0}\nor of a scenario: controllers: [{{kind: feedforward_pid, calibration: {0}}}]", written);
  return job.finish({document, report}, done, job.has_folder() ? next : "");
}

}  // namespace

void add_calibrate(CLI::App& app, Asked& asked) {
  using namespace thesis;
  CLI::App& verb = add_verb(app, "calibrate", models_of_thesis,
                            "Fit the thesis's friction and pressure models to a data set; draw its figures");
  CalibrateOptions& options = asked.when(verb, calibrate_dataset);
  add_measured(verb, options.dataset);
  add_common(verb, options, "out/<name>-calibrate");
  add_rig(verb, options.rig, "instead of the data set's");
  verb.add_flag("--kgf", options.kgf, "Pressures of figures and report in kgf/m2, as the thesis prints them");
  add_choice(verb, "--pressure", options.fits.processing.pressure,
             {{"current", PressureSource::current}, {"gauge", PressureSource::gauge}},
             "Pressure from the current by the valve's line (default: current) or from the gauge");
  add_choice(verb, "--acceleration", options.fits.processing.acceleration,
             {{"counted", Acceleration::counted}, {"neglected", Acceleration::neglected}},
             "Acceleration in the force balance (default: counted)");
  add_choice(verb, "--fit", options.fits.fitting,
             {{"joint", PressureFitting::joint}, {"sequence", PressureFitting::sequence}},
             "Pressure coefficients from all samples at once, "
             "or from the thesis's sequence of fits (default: joint)");
  add_number(verb, "--load-order", options.fits.orders.load, 0, 3,
             "Highest order in load (default: 3, the thesis's)");
  add_number(verb, "--speed-order", options.fits.orders.speed, 0, 2,
             "Highest order in the current's speed (default: 2, the thesis's)");
  verb.footer(
      "Examples:\n"
      "  mckibben calibrate data --out calibration\n"
      "  mckibben calibrate data --pressure gauge --fit sequence --kgf   as the thesis did\n"
      "Writes calibration.yaml (for the open-loop controllers), "
      "calibration.json, report.txt and figures/.\n");
}

}  // namespace mckibben::cli
