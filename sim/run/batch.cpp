// Worker threads that take the next job until there is none.
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <unistd.h>

#include <controllers/process.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::run {

/// Whether work is to stop.
struct Stop {
  std::atomic<bool> asked{false};
  std::atomic<Deadline::Clock::time_point> deadline{Deadline::Clock::time_point::max()};
  bool forgets = true;  ///< once it was taken
};

namespace {

Stop of_the_program;
thread_local Stop* asked_here = &of_the_program;
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

void catch_interrupts() {
  controllers::end_is_asked = interrupted;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    std::signal(signal, [](int again) {
      of_the_program.asked = true;
      // All that a signal handler may do to be seen.
      constexpr std::string_view notice = "\nmckibben: stopping after what is under way; again: at once\n";
      if (again == SIGINT) std::ignore = write(STDERR_FILENO, notice.data(), notice.size());
      std::signal(again, SIG_DFL);  // a second one ends at once
    });
}

HeldInterrupts::HeldInterrupts() {
  struct sigaction hold {};  // without SA_RESTART: who waits wakes up
  hold.sa_handler = [](int signal) {
    const int error = errno;
    of_the_program.asked = true;
    constexpr std::string_view notice = "\nmckibben: stopping\n";
    if (signal == SIGINT) std::ignore = write(STDERR_FILENO, notice.data(), notice.size());
    errno = error;
  };
  for (std::size_t i = 0; i < held.size(); ++i) sigaction(held[i], &hold, &before_[i]);
}

HeldInterrupts::~HeldInterrupts() {
  for (std::size_t i = 0; i < held.size(); ++i) sigaction(held[i], &before_[i], nullptr);
}

bool interrupted() {
  if (asked_here->asked) return true;
  const auto end = asked_here->deadline.load();
  return end != Deadline::Clock::time_point::max() && Deadline::Clock::now() >= end;  // the clock costs time
}

bool take_interrupt() {
  return asked_here->forgets ? asked_here->asked.exchange(false) : asked_here->asked.load();
}

OwnStop::OwnStop() : own_(std::make_unique<Stop>()), before_(asked_here) {
  own_->forgets = false;
  asked_here = own_.get();
}

OwnStop::~OwnStop() {
  asked_here = before_;
}

void OwnStop::ask() {
  own_->asked = true;
}

std::function<void()> inheriting(std::function<void()> work) {
  return [stop = asked_here, work = std::move(work)] {
    asked_here = stop;
    work();
  };
}

Deadline::Deadline(Clock::time_point end) {
  asked_here->deadline = end;
}

Deadline::~Deadline() {
  asked_here->deadline = Clock::time_point::max();
}

void side_by_side(unsigned threads, std::size_t most, const std::function<void()>& work) {
  const std::size_t wanted = threads == 0 ? std::max(1u, std::thread::hardware_concurrency()) : threads;
  std::vector<std::jthread> others;
  try {
    for (std::size_t i = 1; i < std::min(wanted, most); ++i) others.emplace_back(inheriting(work));
  } catch (const std::system_error&) {  // no more threads are to be had: these do it
  }
  work();
}

void for_each_job(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& job,
                  const std::function<void(std::size_t)>& done) {
  std::atomic<std::size_t> next{0}, ended{0};
  std::vector<std::exception_ptr> failures(count);
  const auto work = [&] {
    while (!interrupted()) {
      const std::size_t index = next++;
      if (index >= count) return;
      try {
        job(index);
      } catch (...) {
        failures[index] = std::current_exception();
      }
      done(++ended);
    }
  };
  side_by_side(threads, count, work);
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);
  if (next < count) throw Interrupted();
}

}  // namespace mckibben::run
