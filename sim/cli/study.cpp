// The verb `study`: a campaign simulated in memory, calibrated, and judged by what was true.
#include <filesystem>
#include <string>
#include <utility>

#include <sim/cli/exit_status.hpp>
#include <sim/cli/options.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/output/calibration_report.hpp>
#include <sim/output/chart.hpp>
#include <sim/study/study.hpp>

namespace mckibben::cli {
namespace {

struct StudyOptions : Options {
  std::string study;  ///< one of study::names
  std::string campaign;
};

int make_study(const StudyOptions& options) {
  domain::Campaign campaign = input::read_campaign(std::filesystem::path(options.campaign));
  input::require_load(campaign.rig, options.campaign, "study");
  Job job(options, "study " + options.study + " " + options.campaign,
          "study-" + options.study + "-" + campaign.name, campaign.inputs);
  const study::Evidence evidence = with_progress(campaign.name, [&](const auto& hook) {
    return study::gather(std::move(campaign), options.threads, hook);
  });
  warn(output::warnings_of(evidence.from_current, {}));

  const study::Study made = study::make(options.study, evidence);
  job.write(made.name + ".md", made.page);
  job.write(made.name + ".csv", output::csv_of(made.picture));
  job.write(made.name + ".svg", output::chart_svg(made.picture));
  job.write(made.name + ".json", made.document);
  return job.finish({made.document, made.page}, evidence.failed.empty() ? done : failure);
}

}  // namespace

void add_study(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(app, "study", models_of_thesis,
                            "Simulate and calibrate a campaign; compare what was found with what was true");
  StudyOptions& options = asked.when(verb, make_study);
  verb.add_option("name", options.study,
                  "lag (friction or lag of valve and hose?), counting (what counts at each tick do to the "
                  "load), figures (the thesis's accuracy beside ours)")
      ->required()
      ->check(one_of("study", {study::names.begin(), study::names.end()}))
      ->type_name("");
  add_input(verb, options.campaign, "campaign", "Campaign file", "CAMPAIGN.yaml");
  add_common(verb, options);
  verb.footer(
      "Examples:\n"
      "  mckibben study lag scenarios/thesis_campaign.yaml\n"
      "  mckibben study counting scenarios/thesis_campaign.yaml --json > counting.json\n"
      "Writes NAME.md (the page), NAME.csv and NAME.svg (its picture), NAME.json (every number).\n");
}

}  // namespace mckibben::cli
