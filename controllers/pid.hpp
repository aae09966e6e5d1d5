// PID control of the contraction ratio: positional form, derivative of the measurement through a first-order
// filter, back-calculation against windup (Astrom & Hagglund 1995, section 3). Encoder counts in, mA out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <controllers/current_range.hpp>
#include <controllers/delayed.hpp>
#include <controllers/safety.hpp>

namespace mckibben::controllers {

/// A feedback, whatever limits it has. Its gain is a current for a unit of what is controlled: for a whole
/// contraction ratio, or of a joint for a radian.
struct PidForm {
  std::optional<double> proportional_mA = std::nullopt;
  std::optional<double> integral_time_s = std::nullopt;
  std::optional<double> derivative_time_s = std::nullopt;
  int sample_ticks = 1;
  double derivative_filter = 10.0;
  double setpoint_weight = 1.0;
  std::optional<double> tracking_time_s = std::nullopt;
  int feedback_delay_ticks = 0;
  std::optional<double> tuning_load_kg = std::nullopt;

  /// Whether some gain is left to tuning.
  bool needs_tuning() const { return !proportional_mA || !integral_time_s || !derivative_time_s; }

  static void fields(auto& self, auto& visit) {
    visit("integral_time", self.integral_time_s, "s", 0.0, 1e6,
          "Ti; 0 for no integral action, tuned if absent");
    visit("derivative_time", self.derivative_time_s, "s", 0.0, 1e3,
          "Td; 0 for no derivative action, tuned if absent");
    visit("sample_ticks", self.sample_ticks, 1, 1000, "ticks from one new command to the next");
    visit("derivative_filter", self.derivative_filter, "1", 1.0, 100.0,
          "N: the derivative is filtered with time constant Td/N");
    visit("setpoint_weight", self.setpoint_weight, "1", 0.0, 1.0, "b: share of the target in the K term");
    visit("tracking_time", self.tracking_time_s, "s", 1e-4, 1e6,
          "Tt: how fast a limit unwinds the integral; sqrt(Ti Td) if absent, Ti without derivative action");
    visit("feedback_delay_ticks", self.feedback_delay_ticks, 0, 1000, "age of the counts that are used");
  }
};

/// Everything about the feedback itself.
struct PidTerms : PidForm, SafetyTerms, OutputLimits {
  std::optional<double> dead_zone = std::nullopt;

  static void fields(auto& self, auto& visit) {
    visit("proportional", self.proportional_mA, "mA", 0.0, 1e6,
          "gain K, command for a whole contraction ratio; tuned if absent");
    PidForm::fields(self, visit);
    visit("dead_zone", self.dead_zone, "1", 0.0, 0.5,
          "errors, either way, that count as none: solenoid valves rest there; none if absent");
    OutputLimits::fields(self, visit);
    visit("tuning_load", self.tuning_load_kg, "kg", 0.0, 500.0,
          "load at which missing gains are tuned; the scenario's median load if absent");
    SafetyTerms::fields(self, visit);
  }
};

/// u = base + K (b r - y) + I + D, clamped; dI/dt = K/Ti (r - y) + (u - v)/Tt, with v the unclamped u. The
/// base is a fixed current or a feedforward. While counts are not to be believed the output is held.
class PidLoop {
 public:
  /// Throws std::invalid_argument if a gain is missing.
  PidLoop(const PidTerms& terms, const Knowledge& knowledge);

  /// Output [mA] for the counts of this tick; new at each sample only. Called once each tick.
  double step(const Reading& reading, double base_mA);
  /// The same between limits of this tick's own.
  double step(const Reading& reading, double base_mA, const CurrentRange& limits);

  double clamped(double current_mA) const;
  bool inside_limits(double current_mA) const {
    return current_mA > limits_.lowest_mA && current_mA < limits_.highest_mA;
  }
  /// Adds what the counter did.
  void tell(std::vector<Finding>& findings) const { believed_.tell(findings); }

 private:
  double sample(std::int64_t counts, std::int64_t tick, double base_mA, const CurrentRange& limits);

  PidTerms terms_;
  Knowledge knowledge_;
  double K_mA_, Ti_s_, Td_s_, h_s_;
  CurrentRange limits_;
  double Tt_s_ = 0.0;
  BelievedCounts believed_;
  Delayed<std::int64_t> delayed_;
  bool first_ = true;
  double y_before_ = 0.0, I_mA_ = 0.0, D_mA_ = 0.0, output_mA_ = 0.0;
};

/// Around which current a PID works.
struct RestTerms {
  std::optional<double> rest_current_mA = std::nullopt;

  /// `limits` have followed the range.
  void follow(const OutputLimits& limits, const CurrentRange& range) {
    if (rest_current_mA) return;
    const double low_mA = *limits.lowest_current_mA;
    rest_current_mA =
        std::clamp(range.closed_mA.value_or(low_mA), low_mA, std::max(low_mA, *limits.highest_current_mA));
  }

  static void fields(auto& self, auto& visit) {
    visit("rest_command", self.rest_current_mA, "mA", 0.0, 100.0,
          "command before the first reading, and output without error; if absent lowest_command, of 2/2 "
          "on/off valves the middle, where both are shut");
  }
  void rules(auto& report, const OutputLimits& limits) const {
    if (rest_current_mA && ((limits.lowest_current_mA && *rest_current_mA < *limits.lowest_current_mA) ||
                            (limits.highest_current_mA && *rest_current_mA > *limits.highest_current_mA)))
      report("rest_command", "must lie between lowest_command and highest_command");
  }
};

/// The PID around a fixed current.
struct PidSettings : PidTerms, RestTerms {
  static constexpr std::string_view kind = "pid";
  std::string name{kind};

  void follow(const CurrentRange& range);
  /// Throws std::invalid_argument if a gain is missing.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    PidTerms::fields(self, visit);
    RestTerms::fields(self, visit);
  }
  void rules(auto& report) const {
    PidTerms::rules(report);
    RestTerms::rules(report, *this);
  }
};

}  // namespace mckibben::controllers
