// The verb `dataset`: a campaign's runs, written one by one, so that an interrupted campaign goes on; of an
// ensemble, whose rigs are drawn, in blocks that are gathered into one file. Its folders are no Job.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/cluster/handout.hpp>
#include <sim/data/judged.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/output/campaign_folder.hpp>
#include <sim/output/ensemble_folder.hpp>
#include <sim/output/run_results.hpp>
#include <sim/report/report.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/draws.hpp>
#include <sim/run/simulate.hpp>

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
  const auto finished = [&](std::size_t i, run::Recording recording) {
    folder.put({jobs[i], std::move(recording)});
    handout.done(i);
    progress("simulating", handout.there(), jobs.size());
  };
  progress("simulating", 0, jobs.size());
  do {
    run::simulate_all(
        take, handout.fair_share(), threads, [&](std::size_t i) { return run::order_of(campaign, jobs[i]); },
        finished);
  } while (place.crew().leads() && handout.again());
  if (run::interrupted()) throw run::Interrupted();
}

/// Makes what is missing. What is in memory is the blocks that are under way.
class Blocks {
 public:
  Blocks(const domain::Campaign& campaign, output::EnsembleFolder& folder, cluster::Workplace& place,
         const run::ProgressHook& progress)
      : campaign_(campaign),
        folder_(folder),
        leads_(place.crew().leads()),
        progress_(progress),
        handout_(place, folder.shape().blocks(), [&](std::size_t block) { return folder.has(block); }) {}

  /// Throws Interrupted; what was done by then is kept.
  void operator()(unsigned threads) {
    const std::size_t about = handout_.fair_share() * folder_.shape().in_block;
    do {
      run::simulate_all([&] { return take(); }, about, threads,
                        [&](std::size_t i) { return run::order_of(campaign_, run::job_of(campaign_, i)); },
                        [&](std::size_t i, const run::Recording& recording) { enter(i, recording); });
      tell();
    } while (leads_ && !run::interrupted() && handout_.again());
    for (const auto& [block, runs] : open_) folder_.put(block, runs);
    if (run::interrupted()) throw run::Interrupted();
  }

 private:
  /// The next run that can be simulated; those that cannot are entered at once.
  std::optional<std::size_t> take() {
    const std::lock_guard lock(mutex_);
    while (!run::interrupted()) {
      if (next_ == end_ && !open_next()) return std::nullopt;
      const std::size_t place = next_++;
      auto& block = open_.at(place / folder_.shape().in_block);
      if (block.has(place)) continue;
      const run::CampaignJob job = run::job_of(campaign_, place);
      const std::string unfit = run::unfit(run::drawn_rig(campaign_, job.repeat), job.load_kg);
      if (unfit.empty()) return place;
      run::Recording none;
      none.failure = unfit;
      enter_locked(place, none);
    }
    return std::nullopt;
  }

  bool open_next() {
    const auto block = handout_.take();
    if (!block) return false;
    const auto& opened = open_.insert_or_assign(*block, folder_.begin(*block)).first->second;
    next_ = opened.first();
    end_ = next_ + opened.size();
    return true;
  }

  void enter(std::size_t place, const run::Recording& recording) {
    const std::lock_guard lock(mutex_);
    enter_locked(place, recording);
  }

  void enter_locked(std::size_t place, const run::Recording& recording) {
    const std::size_t number = place / folder_.shape().in_block;
    auto& block = open_.at(number);
    block.put(campaign_, place, recording);
    if (!block.whole()) return;
    folder_.put(number, block);
    open_.erase(number);
    handout_.done(number);
    tell();
  }

  void tell() {
    if (leads_) folder_.gather();
    const auto& shape = folder_.shape();
    progress_("simulating", std::min(shape.runs, handout_.there() * shape.in_block), shape.runs);
  }

  const domain::Campaign& campaign_;
  output::EnsembleFolder& folder_;
  bool leads_;
  const run::ProgressHook& progress_;
  cluster::Handout handout_;
  std::map<std::size_t, run::EnsembleBlock> open_;
  std::size_t next_ = 0, end_ = 0;  ///< runs of the block that was opened last
  std::mutex mutex_;
};

/// A folder of pieces, all of them made by the crew, and what it comes to in rank 0: `make` what is not
/// there, with threads and a hook, then `end`.
template <class Folder, class Make, class End>
int in_pieces(const Options& options, const domain::Campaign& campaign, cluster::Workplace& place,
              Folder& folder, const Make& make, const End& end) {
  place.begin(folder.key());
  try {
    with_progress(campaign.name,
                  [&](const run::ProgressHook& hook) { make(cluster::threads_of(options.threads), hook); });
    if (!place.crew().leads()) return done;
    place.close();
  } catch (const run::Interrupted&) {
    return stopped(folder.runs_there(), folder.all_runs(), folder.unfinished());
  }
  const int status = end();
  place.leave();
  return status;
}

/// Where it goes; nothing that is read may be in a folder that is written.
std::filesystem::path place_of(const Options& options, const domain::Campaign& campaign,
                               std::initializer_list<const char*> suffixes) {
  const auto where = destination(options, campaign.name);
  for (const char* suffix : suffixes) keep_apart(where.string() + suffix, campaign.inputs);
  return where;
}

int make_ensemble(const Options& options, const domain::Campaign& campaign, run::Keep keep) {
  const auto where = place_of(options, campaign, {"", ".unfinished", ".ranks"});
  cluster::Workplace place(where.string() + ".ranks", cluster::crew(), say);
  const bool leads = place.crew().leads();
  output::EnsembleFolder folder(where, campaign, keep, leads ? output::Say(say) : nullptr);
  const auto make = [&](unsigned threads, const run::ProgressHook& progress) {
    do {  // again only for blocks that were not as written
      Blocks(campaign, folder, place, progress)(threads);
    } while (leads && !folder.gathered());
  };
  return in_pieces(options, campaign, place, folder, make, [&] {
    folder.publish();
    print(options, {folder.document(), folder.table()});
    fmt::print(stderr, "ensemble in {}\n", folder.data().string());
    return folder.failed() > 0 ? failure : done;
  });
}

/// What a student is to find: where the rig that is handed out is not the campaign's (campaign_file.cpp). And
/// which effects that rig, in `rig_in`, has already.
std::string hidden_in_words(const domain::Campaign& campaign, const std::string& rig_in) {
  std::vector<std::string> hidden, told;
  const auto sort = [&](const plant::Effects& there, const plant::Effects& known, const char* whose) {
    const input::Json effects = input::to_json(there), handed_out = input::to_json(known);
    for (const auto& [name, numbers] : effects.items())
      (handed_out.value(name, input::Json()) == numbers ? told : hidden).push_back(name + whose);
    for (const auto& [name, numbers] : handed_out.items())
      if (!effects.contains(name)) hidden.push_back("no " + name + whose);
  };
  const plant::Rig &rig = campaign.rig, &known = campaign.known;
  const bool pair = rig.pair() != nullptr;
  sort(rig.effects, known.effects, pair ? " of muscle 1" : "");
  if (pair) sort(rig.pair()->opposite.effects, known.pair()->opposite.effects, " of muscle 2");
  if (rig.joint.load_offset_kg != known.joint.load_offset_kg) hidden.emplace_back("joint.load_offset");
  return fmt::format("hidden: {}{}", hidden.empty() ? "nothing" : fmt::format("{}", fmt::join(hidden, ", ")),
                     told.empty() ? "" : fmt::format("; known from {}: {}", rig_in, fmt::join(told, ", ")));
}

int make_campaign(const DatasetOptions& options, const domain::Campaign& campaign) {
  const auto where = place_of(options, campaign, {"", "-truth", ".unfinished", ".ranks"});
  domain::Campaign nameless = campaign;  // the name may tell what is hidden
  nameless.name = "Data set";
  cluster::Workplace place(where.string() + ".ranks", cluster::crew(), say);
  const output::CampaignFolder folder(where, campaign, options.formats,
                                      place.crew().leads() ? output::Say(say) : nullptr);
  const auto make = [&](unsigned threads, const run::ProgressHook& progress) {
    make_runs(campaign, folder, threads, place, progress);
  };
  return in_pieces(options, campaign, place, folder, make, [&] {
    const std::vector<run::EndedRun> runs = folder.runs();
    folder.publish(runs, [&](const std::filesystem::path& data) {
      return report::report_html(nameless, runs, data::with_rows(input::read_dataset(data)));
    });
    warn(run::warnings_of(runs));
    print(options, {output::json_of(campaign, runs), output::table_of(campaign, runs)});
    fmt::print(stderr, "data set in {}, truth in {}; {}\n", folder.data().string(), folder.truth().string(),
               hidden_in_words(campaign, folder.rig_in()));
    return any_failed(runs) ? failure : done;
  });
}

int make_dataset(const DatasetOptions& options) {
  std::vector<input::Problem> warnings;
  domain::Campaign campaign = input::read_campaign(std::filesystem::path(options.campaign), &warnings);
  if (cluster::crew().leads())
    for (const input::Problem& warning : warnings) fmt::print(stderr, "{}\n", input::to_text(warning));
  if (options.seed) campaign.seed = *options.seed;
  if (!campaign.vary.absent() && !options.formats.empty()) {
    say("--format does not apply to a campaign with `vary`: it writes one NetCDF file; --keep rows or "
        "summary says what is in it");
    return usage_error;
  }
  if (!campaign.vary.absent())
    return make_ensemble(options, campaign, options.keep == "summary" ? run::Keep::summary : run::Keep::rows);
  if (!options.keep.empty()) {
    say(
        fmt::format("--keep applies to campaigns with `vary` only, and {} has none; --format chooses the "
                    "files of its runs",
                    options.campaign));
    return usage_error;
  }
  return make_campaign(options, campaign);
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
