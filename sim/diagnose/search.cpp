// See the header.
#include <algorithm>

#include <sim/diagnose/search.hpp>

namespace mckibben::diagnose {
namespace {

using Clock = run::Deadline::Clock;

Clock::time_point after(double seconds) {
  const std::chrono::duration<double> limit(seconds), left = Clock::time_point::max() - Clock::now();
  if (!(limit < left)) return Clock::time_point::max();  // beyond its end a clock would turn round
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
}

}  // namespace

Search::Search(double limit_s) : limit_s_(limit_s), end_(after(limit_s)) {}

bool Search::part(const std::string& what, const std::function<void()>& job) {
  if (ended_ == Ended::no) {
    try {
      const run::Deadline deadline(end_);
      if (run::interrupted()) throw run::Interrupted();
      job();
      return true;
    } catch (const run::Interrupted&) {
      ended_ = run::take_interrupt() ? Ended::by_user : Ended::by_time;
    }
  }
  if (std::find(not_done_.begin(), not_done_.end(), what) == not_done_.end()) not_done_.push_back(what);
  return false;
}

}  // namespace mckibben::diagnose
