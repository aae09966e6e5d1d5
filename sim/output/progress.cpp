// The progress line.
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include <sim/output/progress.hpp>

namespace mckibben::output {

Progress::Progress(std::string title) : title_(std::move(title)), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

std::function<void(const std::string&, std::size_t, std::size_t)> Progress::hook() {
  return [this](const std::string& what, std::size_t done, std::size_t total) { show(what, done, total); };
}

void Progress::show(const std::string& what, std::size_t done, std::size_t total) {
  const std::scoped_lock lock(mutex_);
  if (what != what_) shown_ = 0;
  if (!terminal_ || done < shown_) return;  // a slower thread may report late
  what_ = what;
  shown_ = done;
  constexpr std::size_t width = 30;
  const std::size_t filled = total == 0 ? width : done * width / total;
  const auto line = fmt::format("\r{}: {} [{}{}] {}/{}\033[K", title_, what, std::string(filled, '#'),
                                std::string(width - filled, '.'), done, total);
  std::fputs(line.c_str(), stderr);
}

}  // namespace mckibben::output
