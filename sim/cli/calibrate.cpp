// The verb `calibrate`: a data set's friction and pressure models, with all figures of the thesis.
#include <filesystem>

#include <sim/cli/exit_status.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/calibration_file.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/output/calibration_report.hpp>
#include <sim/output/chart.hpp>
#include <sim/output/folder.hpp>
#include <sim/report/report.hpp>
#include <sim/run/batch.hpp>
#include <sim/thesis/calibrate.hpp>
#include <sim/thesis/figures.hpp>

namespace mckibben::cli {

int calibrate_dataset(const std::string& path, const Options& options, const CalibrateOptions& how) {
  const domain::Dataset dataset = input::read_dataset(path);
  const auto home = std::filesystem::absolute(dataset.path).lexically_normal().parent_path();
  const auto where = destination(options, home.filename().string() + "-calibration");
  keep_apart(where, dataset.inputs);
  output::ResultFolder folder(where, "calibrate " + path, say);

  const thesis::CalibrationResult result = thesis::calibrate(dataset, how.fits);
  if (run::interrupted()) throw run::Interrupted();
  const std::string document = output::json_of(dataset, result, how.fits).dump(2) + "\n";
  const std::string report = output::report_of(dataset, result, how.fits, how.kgf);
  std::string spreads = "# Spread (standard deviation over mean) of the samples round each model:\n";
  for (const auto& line : output::meanings_of(result, how.fits)) spreads += "#   " + line + "\n";
  folder.write("calibration.yaml", spreads + input::calibration_yaml(result.calibration));
  folder.write("calibration.json", document);
  folder.write("report.txt", report);
  const auto figures = thesis::figures(result, how.kgf);
  folder.write("report.html", report::report_html(dataset, result, how.fits, how.kgf, figures));
  for (const thesis::Figure& figure : figures) {
    folder.write("figures/" + figure.file_name() + ".csv", output::csv_of(figure));
    folder.write("figures/" + figure.file_name() + ".svg", output::chart_svg(figure));
  }
  print(options.json ? document : report);
  publish(folder, where);
  warn(output::warnings_of(result, how.fits));
  return done;
}

}  // namespace mckibben::cli
