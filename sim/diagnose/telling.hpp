// What a diagnosis says of its work: the stage, what it tries there, and how long the stage may still take,
// as what is still to be tried costs what the tries so far have cost.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>

namespace mckibben::diagnose {

/// What begins now: a try, or a stage of so many tries at most.
struct Doing {
  Doing(std::string words) : what(std::move(words)) {}
  Doing(const char* words) : what(words) {}

  std::string what;
  bool is_stage = false;
  std::size_t most_tries = 0;
};
inline Doing stage(std::string name, std::size_t most_tries = 0) {
  Doing doing(std::move(name));
  doing.is_stage = true;
  doing.most_tries = most_tries;
  return doing;
}

/// Hears what begins.
using Step = std::function<void(const Doing&)>;

/// Puts it into words, one after the other.
class Telling {
 public:
  using Clock = std::chrono::steady_clock;

  /// "naming: trying leak (3 of at most 8, at most 12 s left)"
  std::string operator()(const Doing& doing, Clock::time_point now = Clock::now());

 private:
  std::string stage_;
  std::size_t most_tries_ = 0, begun_ = 0;
  Clock::time_point since_{};
};

}  // namespace mckibben::diagnose
