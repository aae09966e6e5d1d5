// A session in real time: a thread that steps it by the machine's clock, commands from any thread in between,
// samples and news for whoever watches, and recordings on their way to disk.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <sim/live/commands.hpp>
#include <sim/live/recording.hpp>
#include <sim/live/session.hpp>

namespace mckibben::live {

/// What a watcher has heard already.
struct Heard {
  std::uint64_t samples = 0, state = 0;
};

class Host {
 public:
  Host(const plant::Rig& rig, double load_kg, DataSets data);
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;
  ~Host();

  /// Does what a command asks for, from the next tick on. Says why it does not; empty if it does.
  std::string obey(const Command& command);

  /// Waits until there is something that a watcher has not heard, but no longer than that. Returns it as one
  /// JSON text, {"from": number of the first, "samples": [[...], ...], "state": {...}}, each only if there is
  /// something new, or nothing. A new watcher hears the last seconds.
  std::string news(Heard& heard, std::chrono::milliseconds longest);

  /// Waits a little for recordings that have ended, and writes them, and what there is of one that goes on;
  /// `say` hears where. What cannot be written is told in the page, too, and kept.
  void write_recordings(const output::Say& say);
  /// Ends: nothing moves any more, and what was being recorded is written. Throws output::CannotWrite.
  void finish(const output::Say& say);

 private:
  void run();
  void step();
  void tell(std::string text);
  void end_recording(const std::string& why);
  std::string state_json() const;
  void changed_state();

  mutable std::mutex mutex_;
  std::condition_variable moved_;
  Session session_;
  std::vector<plant::Channel> channels_;
  DataSets data_;
  bool stop_ = false, running_ = true;
  std::deque<Sample> samples_;
  std::uint64_t first_sample_ = 0, state_ = 1, ticks_ = 0, messages_ = 0;
  std::uint64_t each_;  ///< of so many ticks one is shown
  std::string message_;
  double pace_ = 1.0;  ///< simulated time by the clock's
  std::optional<Recording> recording_;
  std::uint64_t recordings_ = 0;
  std::deque<Recording> ended_;
  std::thread thread_;
};

}  // namespace mckibben::live
