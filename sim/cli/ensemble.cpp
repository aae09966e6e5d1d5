// Ensembles: blocks of runs are claimed, simulated side by side, written, and gathered into one file while
// the others are made.
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include <sim/cli/ensemble.hpp>
#include <sim/cli/exit_status.hpp>
#include <sim/cli/results.hpp>
#include <sim/cluster/handout.hpp>
#include <sim/output/ensemble_folder.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/draws.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::cli {
namespace {

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

}  // namespace

int make_ensemble(const Options& options, const domain::Campaign& campaign, run::Keep keep) {
  const auto where = destination(options, campaign.name);
  for (const char* suffix : {"", ".unfinished", ".ranks"})
    keep_apart(where.string() + suffix, campaign.inputs);
  cluster::Workplace place(where.string() + ".ranks", cluster::crew());
  const bool leads = place.crew().leads();
  output::EnsembleFolder folder(where, campaign, keep, leads ? output::Say(say) : nullptr);
  place.begin(folder.key());
  try {
    with_progress(campaign.name, [&](const auto& hook) {
      const run::ProgressHook progress = hook;
      do {  // again only for blocks that were not as written
        Blocks(campaign, folder, place, progress)(cluster::threads_of(options.threads));
      } while (leads && !folder.gathered());
    });
    if (!leads) return done;
    place.close();
  } catch (const run::Interrupted&) {
    return stopped(folder.runs_there(), folder.shape().runs, folder.unfinished());
  }
  folder.publish();
  print(options, {folder.document(), folder.table()});
  fmt::print(stderr, "ensemble in {}\n", folder.data().string());
  place.leave();
  return folder.failed() > 0 ? failure : done;
}

}  // namespace mckibben::cli
