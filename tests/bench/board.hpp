// The other end of a pseudo-terminal: a microcontroller that speaks the lines of sim/bench/serial.hpp, or
// speaks them wrongly.
#pragma once

#include <algorithm>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

namespace mckibben::bench {

class Board {
 public:
  /// The bytes with which it answers for the n-th time, from 0, with these true counts.
  using Answer = std::function<std::string(int n, long counts)>;

  /// `says_first`: before it answers the greeting.
  explicit Board(
      Answer answer = [](int, long) { return "42\r\n"; }, std::string says_first = "")
      : master_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)),
        answer_(std::move(answer)),
        says_first_(std::move(says_first)) {
    grantpt(master_);
    unlockpt(master_);
    port = ptsname(master_);
    termios raw{};
    tcgetattr(master_, &raw);
    cfmakeraw(&raw);
    tcsetattr(master_, TCSANOW, &raw);
    fcntl(master_, F_SETFL, O_NONBLOCK);
    works_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  }
  ~Board() {
    works_.request_stop();
    works_.join();
    if (master_ >= 0) close(master_);
  }

  std::vector<std::string> heard() {
    const std::lock_guard lock(mutex_);
    return heard_;
  }
  /// Whether the last command that arrives is to vent, in a while.
  bool vented() {
    for (int i = 0; i < 2500; ++i) {
      const auto lines = heard();
      const auto last =
          std::find_if(lines.rbegin(), lines.rend(), [](auto& l) { return l.starts_with('='); });
      if (last != lines.rend() && *last == "=0.0000") return true;
      usleep(2000);
    }
    return false;
  }
  /// In a process that was forked from its own.
  void leave() const { close(master_); }
  static constexpr const char* hang_up = "hang up";  ///< an answer: it does

  std::string port;

 private:
  void work(const std::stop_token& stop) {
    std::string line;
    char c = 0;
    while (!stop.stop_requested() && master_ >= 0) {
      if (read(master_, &c, 1) != 1) {
        usleep(200);
        continue;
      }
      if (c == '\n')
        hear(std::exchange(line, ""));
      else
        line += c;
    }
  }

  void hear(const std::string& line) {
    const std::lock_guard lock(mutex_);
    heard_.push_back(line);
    std::string reply;
    if (line.starts_with("mckibben ")) reply = says_first_ + "ready " + line.substr(9, 1) + "\r\n";
    if (line == "?") reply = answer_(asked_++, static_cast<long>(position_));
    if (line.starts_with("=")) {  // a load that follows the command
      const double wanted = std::max(0.0, (std::strtod(line.c_str() + 1, nullptr) - 4.0) / 16.0 * 500.0);
      position_ += 0.2 * (wanted - position_);
    }
    if (reply == hang_up)
      close(std::exchange(master_, -1));
    else
      for (std::size_t sent = 0; sent < reply.size() && sent < longest_reply;) {
        const ssize_t count = write(master_, reply.data() + sent, reply.size() - sent);
        if (count <= 0) break;  // nobody reads it
        sent += static_cast<std::size_t>(count);
      }
  }

  static constexpr std::size_t longest_reply = 100000;
  int master_, asked_ = 0;
  double position_ = 0.0;
  Answer answer_;
  std::string says_first_;
  std::mutex mutex_;
  std::vector<std::string> heard_;
  std::jthread works_;
};

}  // namespace mckibben::bench
