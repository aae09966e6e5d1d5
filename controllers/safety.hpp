// What people around a rig rely on, the same in every controller.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <controllers/command_filter.hpp>
#include <controllers/controller.hpp>
#include <controllers/current_range.hpp>

namespace mckibben::controllers {

/// Limits besides those of the current itself; none unless given.
struct SafetyTerms : CommandTerms {
  std::optional<double> highest_target = std::nullopt;
  std::optional<double> fastest_load_per_s = std::nullopt;

  bool any() const { return largest_current_speed_mA_per_s || highest_target || fastest_load_per_s; }

  /// What of `range` is within reach of the current of the tick before.
  CurrentRange within_reach(const CurrentRange& range, double before_mA, double tick_s) const {
    if (!largest_current_speed_mA_per_s) return range;
    const double step_mA = *largest_current_speed_mA_per_s * tick_s;
    return {std::clamp(before_mA - step_mA, range.lowest_mA, range.highest_mA),
            std::clamp(before_mA + step_mA, range.lowest_mA, range.highest_mA)};
  }
  double allowed(double target) const { return highest_target ? std::min(target, *highest_target) : target; }

  static void fields(auto& self, auto& visit) {
    CommandTerms::fields(self, visit);
    visit("highest_target", self.highest_target, "1", 0.0, 1.0,
          "contraction ratio at which a higher target is cut (T 2.3: above 0.20 the muscle is at risk)");
    visit("fastest_load", self.fastest_load_per_s, "1/s", 1e-3, 1e6,
          "speed of contraction that no load has: counts that jump further from tick to tick are rejected");
  }
};

/// Ends of the output; those of what the rig's valve answers to unless given.
struct OutputLimits {
  std::optional<double> lowest_current_mA = std::nullopt, highest_current_mA = std::nullopt;

  /// Limits that are left open become the ends of `range`.
  void follow(const CurrentRange& range) {
    if (!lowest_current_mA) lowest_current_mA = range.lowest_mA;
    if (!highest_current_mA) highest_current_mA = range.highest_mA;
  }
  /// What is left of them on a DAC; they have been made to follow a range.
  CurrentRange within(const Knowledge& known) const {
    const double highest_mA = std::min(*highest_current_mA, known.largest_current_mA);
    return {std::min(*lowest_current_mA, highest_mA), highest_mA};
  }

  static void fields(auto& self, auto& visit) {
    visit("lowest_command", self.lowest_current_mA, "mA", 0.0, 100.0,
          "lower limit of the output; the valve's zero_command if absent");
    visit("highest_command", self.highest_current_mA, "mA", 0.0, 100.0,
          "upper limit of the output; the valve's span_command, "
          "or the DAC's largest_command if that is lower, if absent");
  }
  void rules(auto& report) const {
    if (lowest_current_mA && highest_current_mA && *highest_current_mA <= *lowest_current_mA)
      report("highest_command", "must be above lowest_command");
  }
};

/// Tells counts that a load can have reached since the last tick from those of a broken counter.
class BelievedCounts {
 public:
  BelievedCounts(const std::optional<double>& fastest_per_s, const Knowledge& known)
      : largest_step_(fastest_per_s ? std::ceil(*fastest_per_s * known.tick_s / known.contraction_per_count)
                                    : std::numeric_limits<double>::infinity()) {}

  /// The counts, or those that were believed last.
  std::int64_t operator()(std::int64_t counts) {
    lost_ = !first_ && std::abs(static_cast<double>(counts) - static_cast<double>(last_)) > largest_step_;
    first_ = false;
    if (lost_)
      ++lost_ticks_;
    else
      last_ = counts;
    return last_;
  }
  bool lost() const { return lost_; }
  /// Adds `ticks_without_counts`, if there were any.
  void tell(std::vector<Finding>& findings) const {
    if (lost_ticks_ > 0) findings.push_back({"ticks_without_counts", "1", static_cast<double>(lost_ticks_)});
  }

 private:
  double largest_step_;
  bool first_ = true, lost_ = false;
  std::int64_t last_ = 0, lost_ticks_ = 0;
};

}  // namespace mckibben::controllers
