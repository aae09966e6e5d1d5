// The search for what is missing takes as long as there are candidates. A time limit ends it, and so does the
// user; what it has found by then stands, and what it has not done is told.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <sim/run/batch.hpp>

namespace mckibben::diagnose {

enum class Ended { no, by_time, by_user, by_work };

class Search {
 public:
  /// From now on, for so long [s].
  explicit Search(double limit_s = std::numeric_limits<double>::infinity());

  /// Does a part of it. False if the search was ended before or during it: what the part has reached stands,
  /// and `what` is told as not done.
  bool part(const std::string& what, const std::function<void()>& job);

  Ended ended() const { return ended_; }
  double limit_s() const { return limit_s_; }
  /// Parts that were not done to their end.
  const std::vector<std::string>& not_done() const { return not_done_; }

 private:
  double limit_s_;
  run::Deadline::Clock::time_point end_;
  Ended ended_ = Ended::no;
  std::vector<std::string> not_done_;
};

}  // namespace mckibben::diagnose
