// Two muscles against each other as one actuator (T 2.7): muscle 1 is asked for P0 + dP, muscle 2 for P0 -
// dP. The difference turns the joint, the co-contraction P0 makes it stiff. What that is in currents, and how
// far both may go, stands here for every controller of a pair.
#pragma once

#include <cstdint>
#include <numbers>
#include <optional>

#include <controllers/controller.hpp>
#include <controllers/current_range.hpp>

namespace mckibben::controllers {

/// What is asked of every controller of a pair besides its own terms; no limits unless given.
struct JointTerms {
  std::optional<double> co_contraction_Pa = std::nullopt;
  std::optional<double> largest_current_speed_mA_per_s = std::nullopt;
  std::optional<double> lowest_angle_rad = std::nullopt, highest_angle_rad = std::nullopt;
  std::optional<double> fastest_joint_rad_per_s = std::nullopt;

  /// With targets cut at the angles that are allowed.
  Knowledge within_angles(Knowledge known) const;
  /// `fastest_joint` as contraction ratio.
  std::optional<double> fastest_load_per_s(const Knowledge& known) const;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    constexpr double turn_rad = 2.0 * std::numbers::pi;
    visit("co_contraction", self.co_contraction_Pa, "Pa", 0.0, 1e7,
          "P0 that is held; if absent, what nominal muscles take for the wanted stiffness, or the middle of "
          "the valves' pressures where none is wanted");
    visit("largest_command_speed", self.largest_current_speed_mA_per_s, "mA/s", 1e-3, 1e6,
          "how fast each command may change; at once if absent");
    visit("lowest_angle", self.lowest_angle_rad, "rad", -turn_rad, turn_rad,
          "joint angle at which a lower target is cut");
    visit("highest_angle", self.highest_angle_rad, "rad", -turn_rad, turn_rad,
          "joint angle at which a higher target is cut");
    visit("fastest_joint", self.fastest_joint_rad_per_s, "rad/s", 1e-2, 1e4,
          "speed that the joint never has: counts that jump further from tick to tick are rejected");
  }
  template <class Report>
  void rules(Report& report) const {
    if (lowest_angle_rad && highest_angle_rad && *highest_angle_rad <= *lowest_angle_rad)
      report("highest_angle", "must be above lowest_angle");
  }
};

/// Contraction ratio of muscle 1 for each radian of the joint. Throws std::invalid_argument for one muscle.
double ratio_per_rad(const Knowledge& known);

/// A difference is told as the change of the current to muscle 1 that asks for it.
class CoContraction {
 public:
  /// Throws std::invalid_argument if `known` is of one muscle.
  CoContraction(const JointTerms& terms, const Knowledge& known);

  /// Takes the P0 of a tick: what is held, or stiffens nominal muscles as wanted, and `further_Pa`; as near
  /// to it as the valves' lines and the currents before allow. `difference_mA`: about what goes with it.
  void begin_tick(std::int64_t tick, double difference_mA, double further_Pa = 0.0);
  double pressure_Pa() const { return now_Pa_; }
  /// Differences that may go with it: both pressures stay on their lines, both currents within their speed.
  const CurrentRange& differences() const { return differences_; }

  Command command(double difference_mA) const;
  /// What was given in this tick: the currents of the next one follow on it.
  void give(const Command& command) { before_ = command; }

  std::optional<double> wanted_N_m_per_rad(std::int64_t tick) const;
  /// By which the joint stiffens with P0 [N m/rad/Pa], by nominal muscles at an angle (as contraction ratio).
  double stiffening(double ratio) const { return of_muscle_1(ratio) + of_muscle_2(ratio); }
  /// Of all differences that there are.
  double width_mA() const { return width_mA_; }

 private:
  struct Pressures {
    double lowest_Pa, highest_Pa;
  };
  double wanted_Pa(std::int64_t tick, double difference_mA) const;
  Pressures reach(const ValveLine& valve, const std::optional<double>& before_mA) const;
  double of_muscle_1(double ratio) const;
  double of_muscle_2(double ratio) const;

  JointTerms terms_;
  Knowledge known_;
  PairKnowledge pair_;
  double slope_Pa_per_mA_, middle_Pa_, now_Pa_, width_mA_ = 0.0;
  CurrentRange differences_;
  std::optional<Command> before_;
};

}  // namespace mckibben::controllers
