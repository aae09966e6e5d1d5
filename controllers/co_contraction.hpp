// Two muscles against each other as one actuator (T 2.7): muscle 1 is asked for P0 + dP, muscle 2 for P0 -
// dP. The difference turns the joint, the co-contraction P0 makes it stiff. What that is in currents, and how
// far both may go, stands here for every controller of a pair.
#pragma once

#include <cstdint>
#include <optional>

#include <controllers/angle_terms.hpp>
#include <controllers/controller.hpp>
#include <controllers/current_range.hpp>

namespace mckibben::controllers {

/// What is asked of every controller of a pair besides its own terms.
struct JointTerms : AngleTerms {
  std::optional<double> co_contraction_Pa = std::nullopt;

  static void fields(auto& self, auto& visit) {
    visit("co_contraction", self.co_contraction_Pa, "Pa", 0.0, 1e7,
          "P0 that is held; if absent, what nominal muscles take for the wanted stiffness, or the middle of "
          "the valves' pressures where none is wanted");
    AngleTerms::fields(self, visit);
  }
};

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
