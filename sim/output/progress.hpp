// A progress line on a terminal; in a pipe a line now and then.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>

namespace mckibben::output {

/// "title: what [###...] done/total, 20 s left", no longer than `width` characters. The time left is said
/// once a second has been measured, as if what is left went on as what is done. Work without a known end
/// (`total` 0, steps counted in `done`): "title: what, step 12, 20 s so far".
std::string progress_line(const std::string& title, const std::string& what, std::size_t done,
                          std::size_t total, double elapsed_s, std::size_t width);

class Progress {
 public:
  /// Shows that line on stderr while it is a terminal; else once in `every`.
  explicit Progress(std::string title, std::chrono::milliseconds every = std::chrono::seconds(10));
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Clears the line.
  ~Progress();

  /// What to call as work gets done; from any thread, while this lives.
  std::function<void(const std::string& what, std::size_t done, std::size_t total)> hook();

 private:
  using Clock = std::chrono::steady_clock;

  void show(const std::string& what, std::size_t done, std::size_t total);

  std::string title_, what_;
  bool terminal_;
  std::chrono::milliseconds every_;
  std::size_t shown_ = 0;
  Clock::time_point made_ = Clock::now(), began_{}, drawn_{made_};
  std::mutex mutex_;
};

}  // namespace mckibben::output
