// Lines over a serial port (POSIX termios); see the header.
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <controllers/line.hpp>
#include <sim/bench/serial.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::bench {
namespace {

/// Boards restart when their port is opened, and take a while.
constexpr double longest_start_s = 5.0;
constexpr int most_tries = 5;
constexpr std::size_t longest_line = 1024;

}  // namespace

std::string unusual_stage(const plant::Rig& rig) {
  constexpr double of_sketch_mA = 20.0;
  const auto unit = name_of(rig.command_unit());
  const double lowest = rig.dac.lowest_command, largest = rig.dac.largest_command;
  if (rig.command_unit() == plant::CommandUnit::mA && lowest >= 0.0 && largest <= of_sketch_mA) return "";
  return fmt::format(
      "the sketch in scenarios/bench_serial drives a stage of 0 to {:g} mA: write unit[] = \"{}\" and "
      "largest_command = {:g} in it, and use a stage that makes 0 to {:g} {} of its output{}",
      of_sketch_mA, unit, largest, largest, unit,
      lowest < 0.0 ? fmt::format("; it gives nothing below 0: for {:g} {} change put(), too", lowest, unit)
                   : "");
}

Serial::Serial(const std::string& port, const plant::Rig& rig) : port_(port), tick_s_(rig.tick_s) {
  line_ = open(port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  termios how{};
  if (line_ < 0 || tcgetattr(line_, &how) != 0) {
    const std::string why = std::strerror(errno);
    if (line_ >= 0) close(line_);
    throw DeviceFailure(fmt::format("{} cannot be opened as a serial port: {}", port, why));
  }
  cfmakeraw(&how);
  cfsetspeed(&how, B115200);
  tcsetattr(line_, TCSANOW, &how);
  const bool of_mA = rig.command_unit() == plant::CommandUnit::mA;
  const std::string greeting = fmt::format("mckibben {} {}{}", of_mA ? 1 : 2, std::lround(1e3 * tick_s_),
                                           of_mA ? "" : fmt::format(" {}", name_of(rig.command_unit())));
  ready_ = of_mA ? "ready 1" : "ready 2";
  for (int tries = 1;; ++tries) {
    try {
      say(greeting);
      while (heard(longest_start_s / most_tries) != ready_) {  // a board may have much to say as it starts
      }
      return;
    } catch (const DeviceFailure&) {
      if (tries < most_tries && !run::interrupted()) continue;
      close(line_);
      if (run::interrupted()) throw DeviceFailure(port + ": stopped by the user");
      throw DeviceFailure(fmt::format("{}: nobody answers \"{}\" with \"{}\"", port, greeting, ready_));
    }
  }
}

Serial::~Serial() {
  int waiting = 0;  // the last command must arrive; a device that is deaf must not hold us
  for (int looks = 0; looks < 100 && ioctl(line_, TIOCOUTQ, &waiting) == 0 && waiting > 0; ++looks)
    poll(nullptr, 0, 1);
  if (waiting > 0) tcflush(line_, TCOFLUSH);
  close(line_);
}

void Serial::fail(const std::string& what) const {
  throw DeviceFailure(fmt::format("{}: {}", port_, what));
}

void Serial::say(const std::string& line) {
  const std::string whole = (torn_ ? "\n" : "") + line + "\n";
  torn_ = write(line_, whole.data(), whole.size()) != static_cast<ssize_t>(whole.size());
  if (!torn_) return;
  const std::string why = std::strerror(errno);
  tcflush(line_, TCOFLUSH);  // makes room for what comes next: to vent
  fail("cannot write: " + why);
}

/// Whether there was something.
bool Serial::read_some() {
  char bytes[256];
  const ssize_t count = read(line_, bytes, sizeof bytes);
  if (count > 0) received_.append(bytes, static_cast<std::size_t>(count));
  if (count < 0 && errno != EAGAIN && errno != EINTR) fail(std::strerror(errno));
  return count > 0;
}

std::string Serial::heard(double within_s) {
  using Time = std::chrono::steady_clock;
  const auto until =
      Time::now() + std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(within_s));
  for (;;) {
    if (const std::size_t end = received_.find('\n'); end != std::string::npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      if (line.ends_with('\r')) line.pop_back();
      return line;
    }
    if (received_.size() > longest_line)
      fail("a line without end: " + controllers::in_quotes(std::exchange(received_, "")));
    if (run::interrupted()) fail("stopped by the user");
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Time::now()).count();
    if (left <= 0) fail(fmt::format("no answer within {:g} s", within_s));
    pollfd one{line_, POLLIN, 0};
    poll(&one, 1, static_cast<int>(left));
    if (one.revents != 0 && !read_some() && (one.revents & (POLLHUP | POLLERR)) != 0) fail("it has hung up");
  }
}

std::int64_t Serial::counts(double) {
  while (received_.size() <= longest_line && read_some()) {
  }
  if (asked_ && !received_.empty())
    fail("it sent an unrequested line, so its counts may be old: " + controllers::in_quotes(received_));
  received_.clear();
  say("?");
  std::string line;
  do {
    line = heard(10.0 * tick_s_);
  } while (!asked_ && line == ready_);  // to an earlier greeting, which was not heard in time
  asked_ = true;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc() || end != line.data() + line.size())
    fail(controllers::in_quotes(line) + " is no number of counts");
  return value;
}

void Serial::put(double current_mA, double) {
  say(fmt::format("={:.4f}", current_mA));
}

}  // namespace mckibben::bench
