// The verb `study`: a campaign simulated in memory, calibrated, and judged by what was true.
#include <filesystem>

#include <sim/cli/exit_status.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/output/calibration_report.hpp>
#include <sim/output/chart.hpp>
#include <sim/output/progress.hpp>
#include <sim/output/run_json.hpp>
#include <sim/study/study.hpp>

namespace mckibben::cli {

int make_study(const std::string& name, const std::string& path, const Options& options) {
  domain::Campaign campaign = input::read_campaign(std::filesystem::path(path));
  const auto where = destination(options, "study-" + name + "-" + campaign.name);
  keep_apart(where, campaign.inputs);
  output::ResultFolder folder(where, "study " + name + " " + path, say);
  study::Evidence evidence;
  {
    output::Progress progress(campaign.name);
    evidence = study::gather(std::move(campaign), options.threads, progress.hook());
  }
  const study::Study made = study::make(name, evidence);
  input::Json document = output::heading_json("mckibben-study/1", evidence.dataset.inputs);
  document["study"] = made.name;
  document["runs_failed"] = evidence.failed;
  document.update(made.document);
  const std::string text = document.dump(2) + "\n";
  folder.write(name + ".md", made.page);
  folder.write(name + ".csv", output::csv_of(made.picture));
  folder.write(name + ".svg", output::chart_svg(made.picture));
  folder.write(name + ".json", text);
  print(options.json ? text : made.page);
  publish(folder, where);
  warn(output::warnings_of(evidence.from_current, {}));
  return evidence.failed.empty() ? done : failure;
}

}  // namespace mckibben::cli
