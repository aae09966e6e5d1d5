// The verb `dataset`: a campaign's runs, written one by one, so that an interrupted campaign goes on.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include <sim/cli/exit_status.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/output/campaign_folder.hpp>
#include <sim/output/progress.hpp>
#include <sim/output/table.hpp>
#include <sim/report/report.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::cli {

int make_dataset(const std::string& path, const Options& options) {
  domain::Campaign campaign = input::read_campaign(std::filesystem::path(path));
  if (options.seed) campaign.seed = *options.seed;
  const auto where = destination(options, campaign.name);
  for (const char* suffix : {"", "-truth", ".unfinished"})
    keep_apart(where.string() + suffix, campaign.inputs);
  output::CampaignFolder folder(where, campaign, options.formats, say);
  std::atomic<std::size_t> there = folder.jobs().size() - folder.missing().size();
  try {
    output::Progress progress(campaign.name);
    run::run_jobs(
        campaign, folder.missing(), options.threads,
        [&](const run::CampaignRun& run) {
          folder.put(run);
          ++there;
        },
        progress.hook());
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
  print(options.json ? document.dump(2) + "\n" : output::table_of(campaign, document));
  fmt::print(stderr, "data set in {}, truth in {}\n", folder.data().string(), folder.truth().string());
  const auto& runs = document.at("runs");
  const bool failed =
      std::any_of(runs.begin(), runs.end(), [](const auto& run) { return run.contains("failure"); });
  return failed ? failure : done;
}

}  // namespace mckibben::cli
