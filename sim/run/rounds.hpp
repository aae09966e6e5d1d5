// Searches that can only try one thing after another, several of them at once: what they ask for in one round
// is simulated side by side.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

#include <sim/run/simulate.hpp>

namespace mckibben::run {

class Rounds {
 public:
  /// Of so many searches, simulated on `threads` threads (0: all the machine has).
  Rounds(std::size_t searches, unsigned threads) : searches_(searches), threads_(threads) {}

  /// What comes of these runs, in their order. Waits until each of the other searches asks too, or leaves.
  /// Throws Interrupted.
  std::vector<Recording> simulated(std::vector<Order> orders);
  /// To be called once by each search: it asks no more.
  void leave();

 private:
  struct Asked {
    std::vector<Order> orders;
    std::vector<Recording> recordings{};
    std::exception_ptr failure{};
    bool done = false;
  };
  void simulate_round();

  std::size_t searches_;
  unsigned threads_;
  std::mutex mutex_;
  std::condition_variable answered_;
  std::vector<Asked*> round_;
};

/// Calls search(0) ... search(count - 1), each on a thread of its own as far as the machine has any, and
/// waits. The first failure by index is thrown again after all have ended.
void search_in_rounds(std::size_t count, unsigned threads,
                      const std::function<void(std::size_t, Rounds&)>& search);

}  // namespace mckibben::run
