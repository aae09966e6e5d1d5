// Replay; see the header.
#include <atomic>
#include <memory>
#include <optional>
#include <utility>

#include <sim/run/follow.hpp>
#include <sim/run/remembered.hpp>
#include <sim/run/replay.hpp>
#include <sim/run/run_batch.hpp>

namespace mckibben::run {
namespace {

class Replaying {
 public:
  Replaying(const domain::Dataset& dataset, const ProgressHook& progress)
      : dataset_(dataset), progress_(progress) {
    for (const auto& run : dataset.runs)
      runs_.push_back({.id = run.id, .load_kg = run.load_kg, .failure = not_begun});
  }

  std::vector<ReplayedRun> operator()(unsigned threads) {
    progress_("replaying", 0, runs_.size());
    try {
      run_batch(runs_.size(), runs_.size(), threads, [this](std::size_t i) { return task(i); });
    } catch (const Interrupted&) {  // what was not begun says so
    }
    return std::move(runs_);
  }

 private:
  std::optional<BatchTask> task(std::size_t i) {
    const domain::Run& run = dataset_.runs[i];
    Course course = course_of(run, dataset_.rig);
    if (!moves(run)) {
      take(i, without_load());
    } else if (course.begins && dataset_.rig.remembers()) {
      const double from_s = course.time_s.front() + run.measured->recorded.skip_s;
      const auto& seen = run.readings.empty() ? run.measured->read("contraction") : run.values("contraction");
      take(i,
           follow_as_seen(dataset_.rig, run.load_kg, std::move(course), {seen, run.rest_length_m, from_s}));
    } else {
      const auto following =
          std::make_shared<Following>(dataset_.rig, run.load_kg, std::move(course),
                                      [this, i](Recording recording) { take(i, std::move(recording)); });
      return BatchTask{following->key(), [=] { return following; }};
    }
    return std::nullopt;
  }

  /// No load, no motion.
  bool moves(const domain::Run& run) const {
    return !dataset_.rig.lifts_a_load() || run.length_is_given() ||
           (run.measured && run.measured->gives_outer_force()) || dataset_.rig.can_hang(run.load_kg);
  }

  void take(std::size_t i, Recording recording) {
    const domain::Run& run = dataset_.runs[i];
    for (Sample& row : recording.samples) row.time_s = tidy_s(row.time_s);
    recording.driven.force =
        run.find("force") != nullptr || (run.measured && !run.measured->read("force").empty());
    runs_[i].failure = recording.failure;
    if (recording.failure.empty()) runs_[i].gaps = gaps_of(run, dataset_.rig, recording);
    runs_[i].recording = std::move(recording);
    progress_("replaying", ++done_, runs_.size());
  }

  const domain::Dataset& dataset_;
  const ProgressHook& progress_;
  std::vector<ReplayedRun> runs_;
  std::atomic<std::size_t> done_{0};
};

}  // namespace

std::vector<ReplayedRun> replay(const domain::Dataset& dataset, unsigned threads,
                                const ProgressHook& progress) {
  return Replaying(dataset, progress)(threads);
}

}  // namespace mckibben::run
