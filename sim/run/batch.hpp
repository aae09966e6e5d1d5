// Independent jobs spread over threads. Each writes only its own result,
// so results do not depend on their number.
#pragma once

#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <string>

namespace mckibben::run {

/// The user asked to stop (Ctrl-C).
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// Makes Ctrl-C (and SIGTERM, SIGHUP) stop long work between two jobs instead of ending the program.
void catch_interrupts();
/// Whether long work is to stop: the user asked to, or a deadline has passed.
bool interrupted();
/// Whether the user asked to stop. If so, that is forgotten, and what follows goes on; asked again the
/// program ends at once.
bool take_interrupt();

/// While one lives, no signal that can be caught and is sent to end or to suspend the program does so,
/// however often it comes: each asks it to stop. For where the program must do one thing more, such as to
/// vent.
class HeldInterrupts {
 public:
  HeldInterrupts();
  HeldInterrupts(const HeldInterrupts&) = delete;
  HeldInterrupts& operator=(const HeldInterrupts&) = delete;
  ~HeldInterrupts();

 private:
  static constexpr std::array held{SIGINT,  SIGTERM, SIGHUP,  SIGQUIT,   SIGUSR1,
                                   SIGUSR2, SIGALRM, SIGXCPU, SIGVTALRM, SIGTSTP};
  std::array<struct sigaction, held.size()> before_{};
};

struct Stop;

/// What is asked of this thread's work alone, not of all that the program does: while one lives, that work
/// and the threads that it begins ask this one whether they are to stop, whatever others are asked. For
/// programs that do several things at once (sim/python).
class OwnStop {
 public:
  OwnStop();
  OwnStop(const OwnStop&) = delete;
  OwnStop& operator=(const OwnStop&) = delete;
  ~OwnStop();

  /// From any thread. Stays asked.
  void ask();

 private:
  std::unique_ptr<Stop> own_;
  Stop* before_;
};

/// The same work for another thread: there it asks whom this thread asks.
std::function<void()> inheriting(std::function<void()> work);

/// While one lives, work is to stop from `end` on, as if the user asked to.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Deadline(Clock::time_point end);
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;
  ~Deadline();
};

/// Why a run has no result that was not begun when the user stopped.
inline constexpr const char* not_begun = "interrupted before it began";

/// Does `work` on `threads` threads at once (0: as many as the machine has; fewer where no more are to be
/// had), this one among them, at most `most`, and waits.
void side_by_side(unsigned threads, std::size_t most, const std::function<void()>& work);

/// Calls job(0) ... job(count - 1) on `threads` threads (0: as many as the machine has) and waits. `done`
/// hears how many have ended, from any thread. The first failure by index is thrown again after all have
/// ended; Interrupted if the user asked to stop before all were begun.
void for_each_job(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& job,
                  const std::function<void(std::size_t done)>& done);

/// Hears of progress, from any thread: what is being done, how much of it is done.
using ProgressHook = std::function<void(const std::string& what, std::size_t done, std::size_t total)>;

/// Lets other processes do some of the jobs of a stage (sim/cluster): `job` gives its result as bytes, and
/// `take` is given all results, in order; of a stage that is not `for_all`, in one of the processes only.
/// Throws Interrupted.
using Sharing = std::function<void(const std::string& stage, std::size_t count, bool for_all,
                                   const std::function<std::string(std::size_t)>& job,
                                   const std::function<void(std::size_t, const std::string&)>& take)>;

}  // namespace mckibben::run
