// The progress line.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <sim/output/progress.hpp>

namespace mckibben::output {
namespace {

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string words_of(double seconds) {
  const auto s = static_cast<long>(std::ceil(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

}  // namespace

std::string progress_line(const std::string& title, const std::string& what, std::size_t done,
                          std::size_t total, double elapsed_s, std::size_t width) {
  if (total == 0 && done > 0)
    return fmt::format("{}: {}, step {}, {} so far", title, what, done, words_of(elapsed_s)).substr(0, width);
  constexpr std::size_t bar = 30;
  const std::size_t filled = total == 0 ? bar : std::min(done, total) * bar / total;
  std::string line = fmt::format("{}: {} [{}{}] {}/{}", title, what, std::string(filled, '#'),
                                 std::string(bar - filled, '.'), done, total);
  if (elapsed_s >= 1.0 && done > 0 && done < total)
    line += fmt::format(", {} left",
                        words_of(elapsed_s * static_cast<double>(total - done) / static_cast<double>(done)));
  return line.substr(0, width);
}

Progress::Progress(std::string title, std::chrono::milliseconds every)
    : title_(std::move(title)), terminal_(isatty(STDERR_FILENO) == 1), every_(every) {}

Progress::~Progress() {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

std::function<void(const std::string&, std::size_t, std::size_t)> Progress::hook() {
  return [this](const std::string& what, std::size_t done, std::size_t total) { show(what, done, total); };
}

void Progress::show(const std::string& what, std::size_t done, std::size_t total) {
  const std::scoped_lock lock(mutex_);
  const Clock::time_point now = Clock::now();
  const bool begins = what != what_;
  if (begins) {
    what_ = what;
    shown_ = 0;
    began_ = now;
  }
  const bool open_ended = total == 0 && done > 0;
  const double elapsed_s = std::chrono::duration<double>(now - (open_ended ? made_ : began_)).count();
  if (!terminal_ && done > 0 && now - drawn_ >= every_) {
    drawn_ = now;
    fmt::print(stderr, "{}\n", progress_line(title_, what, done, total, elapsed_s, 200));
  }
  if (!terminal_ || done < shown_) return;  // a slower thread may report late
  shown_ = done;
  if (!begins && done < total && now - drawn_ < std::chrono::milliseconds(50))
    return;  // faster than one sees
  drawn_ = now;
  // One character less than the terminal is wide: some go on to the next line after the last.
  const auto line =
      fmt::format("\r{}\033[K", progress_line(title_, what, done, total, elapsed_s, terminal_width() - 1));
  std::fputs(line.c_str(), stderr);
}

}  // namespace mckibben::output
