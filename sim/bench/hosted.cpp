// Two processes on a socket that keeps messages apart (Linux); see the header. What goes to the controller is
// a reading; what comes back begins with a letter: c and a command, f and a failure, e and findings at the
// end.
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <controllers/process.hpp>
#include <sim/bench/hosted.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::bench {
namespace {

using controllers::ControllerFailure;
using controllers::Reading;

constexpr std::int64_t end_of_run = std::numeric_limits<std::int64_t>::max();
constexpr std::size_t longest_message = 60000;
constexpr int loop_was_silent = 75;
constexpr int look_ms = 5;
constexpr double patience_s = 1.5;  // with what is to end; its own process has a second

/// Whether there is something to read by then; false also if this process is asked to end.
bool readable_within(int line, double time_s) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  do {
    pollfd one{line, POLLIN, 0};
    if (poll(&one, 1, look_ms) > 0) return true;
    if (run::interrupted()) return false;
  } while (std::chrono::duration<double>(Clock::now() - begin).count() < time_s);
  return false;
}

bool send_message(int line, const void* bytes, std::size_t count) {
  return send(line, bytes, count, MSG_NOSIGNAL) == static_cast<ssize_t>(count);
}

std::string command_message(const controllers::Command& command) {
  std::string text(1 + sizeof(double), 'c');
  std::memcpy(text.data() + 1, &command.current_mA, sizeof(double));
  return text;
}

std::string end_message(const std::vector<controllers::Finding>& findings) {
  std::string text = "e";
  for (const auto& each : findings)
    text += fmt::format("{}\t{}\t{:.17g}\n", each.name, each.unit, each.value);
  return text;
}

std::vector<controllers::Finding> findings_in(const std::string& message) {
  std::istringstream text(message.substr(1));
  std::vector<controllers::Finding> findings;
  for (std::string name, unit, value;
       std::getline(std::getline(std::getline(text, name, '\t'), unit, '\t'), value);)
    findings.push_back({name, unit, std::strtod(value.c_str(), nullptr)});
  return findings;
}

/// The life of the controller's process.
class Host {
 public:
  Host(int line, std::unique_ptr<controllers::Controller> controller, const Hosting& hosting)
      : line_(line), controller_(std::move(controller)), hosting_(hosting) {}

  int operator()() {
    controllers::Command rest{};
    answer([&] { return command_message(rest = controller_->rest()); });
    for (;;) {
      Reading now;
      if (!readable_within(line_, hosting_.longest_silence_s) ||
          recv(line_, &now, sizeof now, 0) != static_cast<ssize_t>(sizeof now)) {
        hosting_.vent();
        controller_.reset();
        return loop_was_silent;
      }
      if (now.tick == end_of_run) break;
      answer([&] { return command_message(now.tick < hosting_.first_tick ? rest : controller_->step(now)); });
    }
    answer([&] { return end_message(run::findings_for(*controller_, hosting_.rig)); });
    controller_.reset();
    return 0;
  }

 private:
  void answer(const auto& work) {
    std::string text;
    try {
      text = work();
    } catch (const std::exception& failure) {
      text = 'f' + std::string(failure.what()).substr(0, longest_message);
    }
    send_message(line_, text.data(), text.size());
  }

  int line_;
  std::unique_ptr<controllers::Controller> controller_;
  const Hosting& hosting_;
};

[[noreturn]] void live_as_host(int line, pid_t loop, std::unique_ptr<controllers::Controller> controller,
                               const Hosting& hosting) {
  setpgid(0, 0);                     // Ctrl-C is for the loop
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // wakes up who waits, too
  controllers::end_is_asked = run::interrupted;
  if (getppid() != loop) raise(SIGTERM);
  int status = EXIT_FAILURE;
  try {
    status = Host(line, std::move(controller), hosting)();
  } catch (const std::exception& defect) {
    std::fprintf(stderr, "mckibben: %s\n", defect.what());
  }
  std::fflush(nullptr);
  _exit(status);
}

}  // namespace

Hosted::Hosted(std::unique_ptr<controllers::Controller> controller, const Hosting& hosting) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw ControllerFailure(fmt::format("its process cannot be started: {}", std::strerror(errno)));
  std::fflush(nullptr);  // or both would write it
  const pid_t loop = getpid();
  process_ = fork();
  const int error = errno;
  close(ends[process_ == 0 ? 0 : 1]);
  if (process_ == 0) live_as_host(ends[1], loop, std::move(controller), hosting);
  line_ = ends[0];
  if (process_ > 0) return;
  close(line_);
  throw ControllerFailure(fmt::format("its process cannot be started: {}", std::strerror(error)));
}

Hosted::~Hosted() {
  close(line_);
  if (process_ < 0) return;
  kill(process_, SIGTERM);
  if (gone_within(patience_s)) return;
  kill(process_, SIGKILL);
  waitpid(process_, &status_, 0);
}

bool Hosted::gone_within(double time_s) {
  for (int tries = 0; tries * 1e-3 * look_ms <= time_s && process_ > 0; ++tries) {
    if (waitpid(process_, &status_, WNOHANG) == process_) process_ = -1;
    if (process_ > 0) poll(nullptr, 0, look_ms);
  }
  return process_ < 0;
}

std::string Hosted::how_it_ended() const {
  if (process_ > 0) return "the controller's process has hung up";
  if (WIFSIGNALED(status_))
    return std::string("the controller's process was ended by a signal: ") + strsignal(WTERMSIG(status_));
  if (WEXITSTATUS(status_) == loop_was_silent)
    return "the controller's process received nothing from the loop, which was suspended or hung, and has "
           "vented";
  return fmt::format("the controller's process ended with status {}", WEXITSTATUS(status_));
}

void Hosted::show(const Reading& reading) {
  send_message(line_, &reading, sizeof reading);  // if that fails, so does the answer
}

std::string Hosted::heard(const Meanwhile& meanwhile) {
  std::string text(longest_message + 1, '\0');
  for (;; meanwhile()) {
    pollfd one{line_, POLLIN, 0};
    const bool ready = poll(&one, 1, look_ms) > 0;
    const ssize_t count = ready ? recv(line_, text.data(), text.size(), 0) : 0;
    if (count > 0) {
      text.resize(static_cast<std::size_t>(count));
      break;
    }
    if (gone_within(ready ? 1.0 : 0.0)) throw ControllerFailure(how_it_ended());
    if (ready) throw ControllerFailure(how_it_ended());
  }
  if (text[0] == 'f') throw ControllerFailure(text.substr(1));
  return text;
}

double Hosted::answer(const Meanwhile& meanwhile) {
  const std::string text = heard(meanwhile);
  double command = std::numeric_limits<double>::quiet_NaN();
  if (text.size() == 1 + sizeof command) std::memcpy(&command, text.data() + 1, sizeof command);
  return command;
}

std::vector<controllers::Finding> Hosted::end(const Meanwhile& meanwhile) {
  show({.tick = end_of_run});
  std::string text;
  do {
    text = heard(meanwhile);
  } while (text[0] != 'e');  // an answer may still be on its way
  if (!gone_within(patience_s)) throw ControllerFailure("the controller does not end");
  if (status_ != 0) throw ControllerFailure(how_it_ended() + ", once its run was over");
  return findings_in(text);
}

}  // namespace mckibben::bench
