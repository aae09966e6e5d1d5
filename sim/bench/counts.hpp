// Whether an encoder's counts can be true: those that begin far from 0, jump, lie beyond what the muscle can
// do, stand still while the command must have moved the load, or are far from those of the simulated rig.
#pragma once

#include <cstdint>
#include <optional>

#include <plant/rig.hpp>
#include <sim/bench/simulated.hpp>

namespace mckibben::bench {

class CountsWatch {
 public:
  CountsWatch(const plant::Rig& rig, double load_kg);

  /// Looks at those of a tick, `ticks` after the last. Throws DeviceFailure: which, and why they are not
  /// believed.
  void look(std::int64_t counts, std::int64_t tick, int ticks);
  /// The command from that tick on.
  void put(double current_mA);

 private:
  double ratio_of(double counts) const { return counts * per_count_; }
  std::optional<double> expected();

  double tick_s_, time_s_, per_count_, zero_command_, span_command_, command_,
      highest_ratio_ = 0.0, largest_jump_ = 0.0, most_apart_ = 0.0;
  std::optional<Simulated> twin_;  ///< what the rig and its load would do; none once it cannot be simulated
  std::optional<std::int64_t> last_;
  std::int64_t still_ = 0, still_since_ = 0;  ///< counts that have hardly changed since that tick
  std::optional<double> expected_then_{};
  double command_then_ = 0.0;
  std::optional<double> offset_{};  ///< of the counts from the twin's, at first
  std::int64_t near_until_ = 0;     ///< the last tick at which they were not far apart
};

}  // namespace mckibben::bench
