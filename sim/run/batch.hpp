// Independent jobs spread over threads. Each writes only its own result,
// so results do not depend on their number.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>

namespace mckibben::run {

/// The user asked to stop (Ctrl-C).
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// Makes Ctrl-C (and SIGTERM, SIGHUP) stop long work between two jobs instead of ending the program.
void catch_interrupts();
bool interrupted();

/// Why a run has no result that was not begun when the user stopped.
inline constexpr const char* not_begun = "interrupted before it began";

/// Calls job(0) ... job(count - 1) on `threads` threads (0: as many as the machine has) and waits. `done`
/// hears how many have ended, from any thread. The first failure by index is thrown again after all have
/// ended; Interrupted if the user asked to stop before all were begun.
void for_each_job(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& job,
                  const std::function<void(std::size_t done)>& done);

}  // namespace mckibben::run
