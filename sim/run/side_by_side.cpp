// See the header.
#include <algorithm>
#include <deque>
#include <list>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include <sim/run/batch.hpp>
#include <sim/run/side_by_side.hpp>

namespace mckibben::run {
namespace {

/// Errands that are made ready, by class. All threads share them: whoever meets one of another class than
/// its own leaves it there for who comes first.
class Waiting {
 public:
  using Begin = std::function<std::unique_ptr<Errand>()>;

  Waiting(const Take& take, const Prepare& prepare) : take_(take), prepare_(prepare) {}

  /// A class that has one; none if there is none left.
  std::optional<ride::ConvoyClass> any() {
    for (;;) {
      if (const std::lock_guard lock(mutex_); !ready_.empty()) return ready_.begin()->first;
      if (!fetch()) return std::nullopt;
    }
  }

  /// The next of a class; nothing if there is none left.
  Begin next(const ride::ConvoyClass& of) {
    for (;;) {
      {
        const std::lock_guard lock(mutex_);
        if (const auto mine = ready_.find(of); mine != ready_.end()) {
          Begin begin = std::move(mine->second.front());
          mine->second.pop_front();
          if (mine->second.empty()) ready_.erase(mine);
          return begin;
        }
      }
      if (!fetch()) return {};
    }
  }

 private:
  /// Makes one more ready; those that go by themselves are done at once. False if there is none left.
  bool fetch() {
    for (;;) {
      const auto index = take_();
      if (!index) return false;
      if (auto prepared = prepare_(*index)) {
        const std::lock_guard lock(mutex_);
        ready_[std::move(prepared->in)].push_back(std::move(prepared->begin));
        return true;
      }
    }
  }

  const Take& take_;
  const Prepare& prepare_;
  std::mutex mutex_;
  std::map<ride::ConvoyClass, std::deque<Begin>> ready_;
};

/// What one thread does: carries errands of one class side by side until there is none, then of another.
void carry(Waiting& waiting, std::size_t places) {
  while (const auto now = waiting.any()) {
    std::list<std::unique_ptr<Errand>> on_board;
    const auto next = [&]() -> ride::Party* {
      std::erase_if(on_board, [](const auto& errand) { return errand->is_done(); });
      const auto begin = waiting.next(*now);
      if (!begin) return nullptr;
      on_board.push_back(begin());
      return on_board.back().get();
    };
    ride::ride_in_convoy(next, *now, places);
  }
}

}  // namespace

void do_all(const Take& take, std::size_t rigs, unsigned threads, const Prepare& prepare) {
  using engine::Convoy;
  const std::size_t carriers =
      std::min<std::size_t>(rigs, threads == 0 ? std::max(1u, std::thread::hardware_concurrency()) : threads);
  const std::size_t places = rigs > carriers * Convoy::wing ? Convoy::places : Convoy::wing;
  Waiting waiting(take, prepare);
  for_each_job(
      carriers, threads, [&](std::size_t) { carry(waiting, places); }, [](std::size_t) {});
}

}  // namespace mckibben::run
