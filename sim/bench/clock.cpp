// The machine's clock (POSIX): sleeps to an instant, so that lateness does not add up.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <ctime>

#include <sim/bench/device.hpp>

namespace mckibben::bench {
namespace {

double monotonic_s() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

RealClock::RealClock() : begin_s_(monotonic_s()) {}

double RealClock::now_s() {
  return monotonic_s() - begin_s_;
}

void RealClock::wait_until(double time_s) {
  const double at_s = time_s + begin_s_;
  timespec until{};
  until.tv_sec = static_cast<time_t>(std::floor(at_s));
  until.tv_nsec = std::min(999'999'999L, std::lround(1e9 * (at_s - std::floor(at_s))));
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace mckibben::bench
