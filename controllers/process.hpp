// A program in a process of its own that answers each line with a line (POSIX). Its death, its silence and
// its chatter are failures with a reason; whatever it does, this process goes on.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include <sys/types.h>

namespace mckibben::controllers {

/// Whether the user asked this program to end: then nobody waits for a process any longer. Looked at often.
inline bool (*end_is_asked)() = [] { return false; };

class Process {
 public:
  /// Starts `command` with the shell, in `folder` (where we are if it is empty). Throws ControllerFailure.
  Process(const std::string& command, const std::string& folder);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  /// Hangs up. What has not ended a second later is killed, with all that it has started.
  ~Process();

  /// Hands over `lines`, which end with a line end, and waits for one line, which is given without it and
  /// valid until the next call. Throws ControllerFailure where none comes within the time, or more than one.
  std::string_view ask(std::string_view lines, double within_s);

 private:
  using Clock = std::chrono::steady_clock;

  /// Waits for what there is to write or to read; false once its output has ended.
  bool exchange(std::string_view& rest, Clock::time_point until);
  bool take(int& from, std::string& into, std::size_t most);
  [[noreturn]] void fail(const std::string& why);
  std::string how_it_ended();
  std::string last_words() const;
  void hang_up(double patience_s);

  pid_t child_ = -1;
  int to_ = -1, from_ = -1, complaints_ = -1;
  int status_ = 0;
  std::string said_, complained_;  ///< not yet taken; the end of what it said on stderr
  std::size_t taken_ = 0;          ///< length of the line that was handed out
};

}  // namespace mckibben::controllers
