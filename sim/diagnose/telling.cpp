// See the header.
#include <cmath>

#include <fmt/format.h>

#include <sim/diagnose/telling.hpp>

namespace mckibben::diagnose {

std::string Telling::operator()(const Doing& doing, Clock::time_point now) {
  if (doing.is_stage) {
    stage_ = doing.what;
    most_tries_ = doing.most_tries;
    begun_ = 0;
    since_ = now;
    return stage_;
  }
  const std::size_t over = begun_++;
  std::string what = stage_.empty() ? doing.what : fmt::format("{}: {}", stage_, doing.what);
  if (begun_ > most_tries_) return what;
  std::string left;
  if (over > 0) {
    const double each_s = std::chrono::duration<double>(now - since_).count() / static_cast<double>(over);
    left =
        fmt::format(", at most {:.0f} s left", std::ceil(each_s * static_cast<double>(most_tries_ - over)));
  }
  return fmt::format("{} ({} of at most {}{})", what, begun_, most_tries_, left);
}

}  // namespace mckibben::diagnose
