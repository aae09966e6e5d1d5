// The verb `dataset`: a campaign's runs, written one by one, so that an interrupted campaign goes on. Its two
// folders are no Job.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/cli/exit_status.hpp>
#include <sim/cli/options.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/output/campaign_folder.hpp>
#include <sim/output/table.hpp>
#include <sim/report/report.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::cli {
namespace {

struct DatasetOptions : Options {
  std::string campaign;
  std::vector<std::string> formats;  ///< of runs, besides CSV
};

int make_dataset(const DatasetOptions& options) {
  domain::Campaign campaign = input::read_campaign(std::filesystem::path(options.campaign));
  if (options.seed) campaign.seed = *options.seed;
  const auto where = destination(options, campaign.name);
  for (const char* suffix : {"", "-truth", ".unfinished"})
    keep_apart(where.string() + suffix, campaign.inputs);
  output::CampaignFolder folder(where, campaign, options.formats, say);
  std::atomic<std::size_t> there = folder.jobs().size() - folder.missing().size();
  try {
    const auto put = [&](const run::CampaignRun& run) {
      folder.put(run);
      ++there;
    };
    with_progress(campaign.name, [&](const auto& hook) {
      run::run_jobs(campaign, folder.missing(), options.threads, put, hook);
    });
  } catch (const run::Interrupted&) {
    fmt::print(stderr,
               "mckibben: interrupted; {} of {} runs are in {}\n"
               "The same command goes on from there. Earlier results are as they were.\n",
               there.load(), folder.jobs().size(), folder.unfinished().string());
    return interrupted;
  }
  const input::Json document = folder.document();
  folder.publish(document, [&](const std::filesystem::path& data) {
    return report::report_html(campaign, document, input::read_dataset(data));
  });
  print(options, {document.dump(2) + "\n", output::table_of(campaign, document)});
  fmt::print(stderr, "data set in {}, truth in {}\n", folder.data().string(), folder.truth().string());
  const auto& runs = document.at("runs");
  const bool failed =
      std::any_of(runs.begin(), runs.end(), [](const auto& run) { return run.contains("failure"); });
  return failed ? failure : done;
}

}  // namespace

void add_dataset(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(app, "dataset", to_simulate,
                            "Simulate a campaign; write a calibration data set and, apart, the truth");
  DatasetOptions& options = asked.when(verb, make_dataset);
  add_input(verb, options.campaign, "campaign", "Campaign file", "CAMPAIGN.yaml");
  add_common(verb, options);
  add_seed(verb, options, "the noise (default: the campaign's)");
  add_formats(verb, options.formats);
  verb.footer(
      "Examples:\n"
      "  mckibben dataset scenarios/thesis_campaign.yaml --out data\n"
      "  mckibben dataset my_campaign.yaml --seed 2       the same measured again, with other noise\n"
      "Writes data/ and data-truth/. If interrupted, the same command goes on where it stopped.\n");
}

}  // namespace mckibben::cli
