// A progress line on a terminal, nothing in a pipe.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>

namespace mckibben::output {

class Progress {
 public:
  /// Shows "title: what [###...] done/total" on stderr while it is a terminal.
  explicit Progress(std::string title);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Clears the line.
  ~Progress();

  /// What to call as work gets done; from any thread, while this lives.
  std::function<void(const std::string& what, std::size_t done, std::size_t total)> hook();

 private:
  void show(const std::string& what, std::size_t done, std::size_t total);

  std::string title_, what_;
  bool terminal_;
  std::size_t shown_ = 0;
  std::mutex mutex_;
};

}  // namespace mckibben::output
