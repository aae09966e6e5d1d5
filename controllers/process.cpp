// A child process on a socket and two pipes; see the header. posix_spawn, and not fork, because other threads
// of ours may hold locks; a socket, and not a pipe, because what is written to a dead child must not raise
// SIGPIPE; a process group of its own, because Ctrl-C is for us to act on, and to kill all that it starts.
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <controllers/controller.hpp>
#include <controllers/line.hpp>
#include <controllers/process.hpp>

extern char** environ;

namespace mckibben::controllers {
namespace {

constexpr std::size_t longest_line = 4096, kept_of_complaints = 4096;

[[noreturn]] void no_process(int error) {
  throw ControllerFailure(std::string("its process cannot be started: ") + std::strerror(error));
}

/// Two ends of what two processes hold; closed unless they are taken.
struct Ends {
  std::array<int, 2> ends{-1, -1};
  Ends() = default;
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;
  ~Ends() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  int take(std::size_t i) { return std::exchange(ends[i], -1); }
};

/// What posix_spawn is told; freed with it.
struct Spawning {
  posix_spawn_file_actions_t files{};
  posix_spawnattr_t attributes{};
  Spawning() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);  // what we ignore it need not
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  Spawning(const Spawning&) = delete;
  Spawning& operator=(const Spawning&) = delete;
  ~Spawning() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
};

}  // namespace

Process::Process(const std::string& command, const std::string& folder) {
  Ends line, answers, complaints;
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, line.ends.data()) != 0 ||
      pipe2(answers.ends.data(), O_CLOEXEC) != 0 || pipe2(complaints.ends.data(), O_CLOEXEC) != 0)
    no_process(errno);
  Spawning spawning;
  posix_spawn_file_actions_adddup2(&spawning.files, line.ends[1], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&spawning.files, answers.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&spawning.files, complaints.ends[1], STDERR_FILENO);
  if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&spawning.files, folder.c_str());
  std::array<std::string, 3> words{"sh", "-c", command};
  std::array<char*, 4> arguments{words[0].data(), words[1].data(), words[2].data(), nullptr};
  const int error =
      posix_spawn(&child_, "/bin/sh", &spawning.files, &spawning.attributes, arguments.data(), environ);
  if (error != 0) no_process(error);
  to_ = line.take(0), from_ = answers.take(0), complaints_ = complaints.take(0);
  for (const int end : {to_, from_, complaints_}) fcntl(end, F_SETFL, O_NONBLOCK);
}

Process::~Process() {
  hang_up(1.0);
}

std::string_view Process::ask(std::string_view lines, double within_s) {
  said_.erase(0, taken_);
  taken_ = 0;
  if (!said_.empty()) fail("it said more than one line: " + in_quotes(said_));
  const auto until =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(within_s));
  for (;;) {
    if (end_is_asked()) fail("the user stopped before it answered");
    if (!exchange(lines, until)) fail(how_it_ended());
    const std::size_t length = said_.find('\n');
    if (length != std::string::npos) {
      taken_ = length + 1;
      return std::string_view(said_).substr(0, length);
    }
    const bool too_late = Clock::now() >= until;
    if (too_late && said_.empty()) {
      std::string limit;
      append(limit, within_s);
      fail("no answer within " + limit + " s");
    }
    if (too_late || said_.size() > longest_line) fail("its answer is no line: " + in_quotes(said_));
  }
}

bool Process::exchange(std::string_view& rest, Clock::time_point until) {
  std::array<pollfd, 3> ends{pollfd{from_, POLLIN, 0}, pollfd{complaints_, POLLIN, 0},
                             pollfd{rest.empty() ? -1 : to_, POLLOUT, 0}};
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
  constexpr decltype(left) longest_ms = 50;  // whoever waits looks up so often
  poll(ends.data(), ends.size(), static_cast<int>(std::clamp<decltype(left)>(left, 0, longest_ms)));
  if (ends[1].revents != 0) take(complaints_, complained_, kept_of_complaints);
  if (ends[2].revents != 0) {
    const ssize_t sent = send(to_, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (sent > 0) rest.remove_prefix(static_cast<std::size_t>(sent));
    if (sent < 0 && errno != EAGAIN && errno != EINTR) rest = {};  // it hears no more, but may still answer
  }
  return ends[0].revents == 0 || take(from_, said_, std::string::npos);
}

/// Reads what there is; false once there will be no more.
bool Process::take(int& from, std::string& into, std::size_t most) {
  std::array<char, 4096> bytes;
  const ssize_t count = read(from, bytes.data(), bytes.size());
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return true;
  if (count <= 0) {
    close(std::exchange(from, -1));
    return false;
  }
  into.append(bytes.data(), static_cast<std::size_t>(count));
  if (into.size() > most) into.erase(0, into.size() - most);
  return true;
}

void Process::fail(const std::string& why) {
  throw ControllerFailure(why + last_words());
}

/// It has closed its output: mostly because it is no more.
std::string Process::how_it_ended() {
  hang_up(0.5);
  if (WIFEXITED(status_)) return "it ended with status " + std::to_string(WEXITSTATUS(status_));
  if (WTERMSIG(status_) == SIGKILL) return "it closed its output";
  return std::string("it was ended by a signal: ") + strsignal(WTERMSIG(status_));
}

std::string Process::last_words() const {
  const std::size_t end = complained_.find_last_not_of(" \n\r\t");
  if (end == std::string::npos) return "";
  const std::string_view all = std::string_view(complained_).substr(0, end + 1);
  const std::size_t line = all.rfind('\n');
  return "; its last words: " + in_quotes(line == std::string_view::npos ? all : all.substr(line + 1));
}

void Process::hang_up(double patience_s) {
  if (child_ < 0) return;
  close(std::exchange(to_, -1));
  const auto until =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience_s));
  std::string_view nothing;
  while ((from_ >= 0 || complaints_ >= 0) && Clock::now() < until) {
    exchange(nothing, until);
    said_.clear();
  }
  siginfo_t gone{};
  while (waitid(P_PID, static_cast<id_t>(child_), &gone, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         gone.si_pid == 0 && Clock::now() < until)
    poll(nullptr, 0, 1);
  kill(-child_, SIGKILL);  // it, or what it has left behind
  while (waitpid(std::exchange(child_, -1), &status_, 0) < 0 && errno == EINTR) {
  }
  for (int* const end : {&from_, &complaints_})
    if (*end >= 0) close(std::exchange(*end, -1));
}

}  // namespace mckibben::controllers
