// A round is simulated by the search that asks last, while the others wait; see the header.
#include <algorithm>
#include <atomic>
#include <latch>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include <sim/run/batch.hpp>
#include <sim/run/rounds.hpp>

namespace mckibben::run {

std::vector<Recording> Rounds::simulated(std::vector<Order> orders) {
  std::unique_lock lock(mutex_);
  Asked mine{.orders = std::move(orders)};
  round_.push_back(&mine);
  if (round_.size() == searches_)
    simulate_round();
  else
    answered_.wait(lock, [&] { return mine.done; });
  if (mine.failure) std::rethrow_exception(mine.failure);
  return std::move(mine.recordings);
}

void Rounds::leave() {
  const std::lock_guard lock(mutex_);
  --searches_;
  if (!round_.empty() && round_.size() == searches_) simulate_round();
}

void Rounds::simulate_round() {
  std::vector<std::pair<Asked*, std::size_t>> runs;
  for (Asked* asked : round_) {
    asked->recordings.resize(asked->orders.size());
    for (std::size_t i = 0; i < asked->orders.size(); ++i) runs.emplace_back(asked, i);
  }
  std::exception_ptr failure;
  try {
    simulate_all(
        runs.size(), threads_,
        [&](std::size_t i) { return std::move(runs[i].first->orders[runs[i].second]); },
        [&](std::size_t i, Recording recording) {
          runs[i].first->recordings[runs[i].second] = std::move(recording);
        });
  } catch (...) {
    failure = std::current_exception();
  }
  for (Asked* asked : std::exchange(round_, {})) {
    asked->failure = failure;
    asked->done = true;
  }
  answered_.notify_all();
}

void search_in_rounds(std::size_t count, unsigned threads,
                      const std::function<void(std::size_t, Rounds&)>& search) {
  constexpr std::size_t most_at_once = 32;
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> failures(count);
  std::optional<Rounds> rounds;  // once it is known how many threads there are
  std::latch known(1);
  const auto work = [&] {
    known.wait();
    for (std::size_t i = next++; i < count; i = next++) try {
        search(i, *rounds);
      } catch (...) {
        failures[i] = std::current_exception();
      }
    rounds->leave();
  };
  {
    std::vector<std::jthread> others;
    try {
      while (others.size() + 1 < std::min(count, most_at_once)) others.emplace_back(inheriting(work));
    } catch (const std::system_error&) {  // no more threads are to be had: these do it
    }
    rounds.emplace(others.size() + 1, threads);
    known.count_down();
    work();
  }
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace mckibben::run
