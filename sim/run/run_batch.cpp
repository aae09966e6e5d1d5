// See the header.
#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <queue>
#include <thread>
#include <utility>

#include <sim/run/batch.hpp>
#include <sim/run/run_batch.hpp>

namespace mckibben::run {
namespace {

/// Tasks that are made, by key. All threads share them: who meets one of another key than its batch's leaves
/// it there for who comes first.
class Tasks {
 public:
  Tasks(const Take& take, const Prepare& prepare) : take_(take), prepare_(prepare) {}

  /// The next with a key, or with any; none if there is none left.
  std::optional<BatchTask> next(const std::optional<ride::BatchKey>& key) {
    do {
      const std::lock_guard lock(mutex_);
      const auto mine = key ? made_.find(*key) : made_.begin();
      if (mine == made_.end()) continue;
      BatchTask task{mine->first, std::move(mine->second.front())};
      mine->second.pop();
      if (mine->second.empty()) made_.erase(mine);
      return task;
    } while (make());
    return std::nullopt;
  }

 private:
  /// One more; those that go alone are done at once. False if there is none left.
  bool make() {
    while (const auto index = take_()) {
      auto task = prepare_(*index);
      if (!task) continue;
      if (task->key.in_lanes) {
        const std::lock_guard lock(mutex_);
        made_[std::move(task->key)].push(std::move(task->begin));
        return true;
      }
      const auto item = task->begin();
      ride::Alone(item->riders(), task->key).run(*item);
    }
    return false;
  }

  const Take& take_;
  const Prepare& prepare_;
  std::mutex mutex_;
  std::map<ride::BatchKey, std::queue<decltype(BatchTask::begin)>> made_;
};

}  // namespace

void run_batch(const Take& take, std::size_t rigs, unsigned threads, const Prepare& prepare) {
  using engine::Batch;
  const std::size_t batches =
      std::min<std::size_t>(rigs, threads == 0 ? std::max(1u, std::thread::hardware_concurrency()) : threads);
  const std::size_t lanes = rigs > batches * Batch::width ? Batch::most_lanes : Batch::width;
  Tasks tasks(take, prepare);
  const auto simulate = [&](std::size_t) {
    // Tasks of one key in a batch until there is none, then of another.
    while (auto task = tasks.next({})) {
      const std::optional key = task->key;
      ride::Batch(*key, lanes).run([&] {
        const auto begin = task ? std::exchange(task, {}) : tasks.next(key);
        return begin ? begin->begin() : nullptr;
      });
    }
  };
  for_each_job(batches, threads, simulate, [](std::size_t) {});
}

void run_batch(std::size_t count, std::size_t rigs, unsigned threads, const Prepare& prepare) {
  std::atomic<std::size_t> taken{0};
  const Take take = [&]() -> std::optional<std::size_t> {
    const std::size_t index = interrupted() ? count : taken++;
    return index < count ? std::optional(index) : std::nullopt;
  };
  run_batch(take, rigs, threads, prepare);
  if (taken < count) throw Interrupted();
}

}  // namespace mckibben::run
