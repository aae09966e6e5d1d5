// The verb `dataset`: a campaign's runs, written one by one, so that an interrupted campaign goes on. Its two
// folders are no Job.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/cli/ensemble.hpp>
#include <sim/cli/exit_status.hpp>
#include <sim/cli/options.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/cluster/handout.hpp>
#include <sim/data/judged.hpp>
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
  std::string keep;                  ///< of the runs of an ensemble; empty if not said
};

/// Makes the runs that are not there yet, with the rest of the crew; rank 0 waits until all are there.
void make_runs(const domain::Campaign& campaign, const output::CampaignFolder& folder, unsigned threads,
               cluster::Workplace& place, const run::ProgressHook& progress) {
  const auto jobs = run::longest_first(campaign, folder.jobs());
  cluster::Handout handout(place, jobs.size(), [&](std::size_t i) { return folder.has(jobs[i]); });
  const auto take = [&] { return handout.take(); };
  const auto finished = [&](std::size_t i, const run::CampaignRun& run) {
    folder.put(run);
    handout.done(i);
    progress("simulating", handout.there(), jobs.size());
  };
  progress("simulating", 0, jobs.size());
  do {
    run::run_jobs(campaign, jobs, take, handout.fair_share(), threads, finished);
  } while (place.crew().leads() && handout.again());
  if (run::interrupted()) throw run::Interrupted();
}

std::size_t runs_in(const output::CampaignFolder& folder) {
  const auto& jobs = folder.jobs();
  return static_cast<std::size_t>(
      std::count_if(jobs.begin(), jobs.end(), [&](const auto& job) { return folder.has(job); }));
}

int make_dataset(const DatasetOptions& options) {
  domain::Campaign campaign = input::read_campaign(std::filesystem::path(options.campaign));
  if (options.seed) campaign.seed = *options.seed;
  if (!campaign.vary.absent()) {
    if (!options.formats.empty()) {
      say("--format does not apply to a campaign with `vary`: it writes one NetCDF file; --keep rows or "
          "summary says what is in it");
      return usage_error;
    }
    return make_ensemble(options, campaign, options.keep == "summary" ? run::Keep::summary : run::Keep::rows);
  }
  if (!options.keep.empty()) {
    say(
        fmt::format("--keep applies to campaigns with `vary` only, and {} has none; --format chooses the "
                    "files of its runs",
                    options.campaign));
    return usage_error;
  }
  const auto where = destination(options, campaign.name);
  for (const char* suffix : {"", "-truth", ".unfinished", ".ranks"})
    keep_apart(where.string() + suffix, campaign.inputs);
  cluster::Workplace place(where.string() + ".ranks", cluster::crew());
  const output::CampaignFolder folder(where, campaign, options.formats,
                                      place.crew().leads() ? output::Say(say) : nullptr);
  place.begin(folder.key());
  try {
    with_progress(campaign.name, [&](const auto& hook) {
      make_runs(campaign, folder, cluster::threads_of(options.threads), place, hook);
    });
    if (!place.crew().leads()) return done;
    place.close();
  } catch (const run::Interrupted&) {
    return stopped(runs_in(folder), folder.jobs().size(), folder.unfinished());
  }
  const std::vector<run::EndedRun> runs = folder.runs();
  folder.publish(runs, [&](const std::filesystem::path& data) {
    return report::report_html(campaign, runs, data::with_rows(input::read_dataset(data)));
  });
  warn(run::warnings_of(runs));
  print(options, {output::json_of(campaign, runs), output::table_of(campaign, runs)});
  fmt::print(stderr, "data set in {}, truth in {}\n", folder.data().string(), folder.truth().string());
  place.leave();
  const bool failed =
      std::any_of(runs.begin(), runs.end(), [](const auto& run) { return !run.failure.empty(); });
  return failed ? failure : done;
}

}  // namespace

void add_dataset(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(app, "dataset", to_simulate,
                            "Simulate a campaign; write a calibration data set and, apart, the truth");
  DatasetOptions& options = asked.when(verb, make_dataset, Ranks::share);
  add_input(verb, options.campaign, "campaign", "Campaign file", "CAMPAIGN.yaml");
  add_common(verb, options);
  add_seed(verb, options, "the noise (default: the campaign's)");
  add_formats(verb, options.formats);
  verb.add_option("--keep", options.keep, "Of campaigns that vary: every row of each run, or metrics only")
      ->check(one_of("part", {"rows", "summary"}));
  verb.footer(
      "Examples:\n"
      "  mckibben dataset scenarios/thesis_campaign.yaml --out data\n"
      "  mckibben dataset my_campaign.yaml --seed 2       the same measured again, with other noise\n"
      "  mckibben dataset joint.yaml                      two muscles on one wheel "
      "(docs/datasets.md)\n"
      "  mckibben dataset ensemble.yaml --keep summary    10^5 drawn rigs (vary: ...), metrics in one file\n"
      "  mpirun -n 4 mckibben dataset my_campaign.yaml    or srun: spread over processes (docs/cluster.md)\n"
      "Writes data/ and data-truth/. If interrupted, the same command goes on where it stopped.\n");
}

}  // namespace mckibben::cli
