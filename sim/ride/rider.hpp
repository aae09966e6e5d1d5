// One rig on its way, and the order of an instant, which stands in rider.cpp and nowhere else:
//
//   x-         state that was reached; what the instruments see of it
//   hold       held = { play(P_ref(i)) + stray, nu = change of i / length of the step } of each side, or the
//              slope of a pressure that is given; w of a length that is given; a force on the joint
//              Coulomb friction: a load that sticks is judged anew
//   moment     forces and flows at (x-, held)
//   (an integrator carries x- to x+; where commands come late, from one that is felt to the next)
//   arrive     what the instruments see of x+
//
// Times are the caller's. What carries riders: ride.hpp, batch.hpp.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <plant/plant.hpp>
#include <sim/engine/problem.hpp>
#include <sim/ride/past.hpp>
#include <sim/ride/switch.hpp>

namespace mckibben::ride {

/// A rig, and the load [kg] that hangs on it where its mechanics have one.
struct Loaded {
  plant::Rig rig;
  double load_kg = 0.0;
};

/// What acts on a muscle from outside, from one instant to the next: a command, or in its place the pressure
/// that the valve's volume or the muscle has at the end, and runs straight to.
struct Command {
  double current_mA = 0.0;                     ///< as a DAC gives it
  double stray_current_mA = 0.0;               ///< reaches the valve besides, and is in no table
  double stray_pressure_Pa = 0.0;              ///< on the reference that the valve follows, in the end
  std::optional<double> muscle_pressure_Pa{};  ///< of a sealed muscle: what fills it; without it is shut
  std::optional<double> valve_pressure_Pa{};   ///< where that of the muscle is not given

  plant::GivenPressure given() const {
    if (muscle_pressure_Pa) return plant::GivenPressure::muscle;
    return valve_pressure_Pa ? plant::GivenPressure::valve : plant::GivenPressure::none;
  }

  static void members(auto& self, auto& visit) {
    visit(self.current_mA, self.stray_current_mA, self.stray_pressure_Pa, self.muscle_pressure_Pa,
          self.valve_pressure_Pa);
  }
};

/// What acts on a rig: on its muscle, on the opposite one of a pair, on the joint a bench that gives the
/// (first) muscle the length that it has at the end, straight, or a force on the cord beside the load.
struct Drive : Command {
  std::optional<double> contraction_ratio{};
  Command opposite{};
  double joint_force_N = 0.0;                  ///< held until then; positive lengthens the (first) muscle
  std::optional<double> supply_pressure_Pa{};  ///< held until then; none: the rig's

  static void members(auto& self, auto& visit) {
    Command::members(self, visit);
    visit(self.contraction_ratio, self.opposite, self.joint_force_N, self.supply_pressure_Pa);
  }
};

/// What acts while a rig settles: as long as that, a sealed muscle is being filled.
Drive settling(Drive drive, const plant::Rig& rig);

/// What instruments see at an instant, before they count or round.
struct Reading {
  double wheel_m = 0.0;    ///< rise that the encoder's wheel shows; of a pair, from theta = 0
  double misread_m = 0.0;  ///< what of it is not the joint's
  /// As sensors on each muscle show it; a force only where its sensor is late.
  std::array<plant::BySensed, 2> sides{};

  plant::BySensed& of(std::size_t muscle) { return sides[muscle == 2 ? 1 : 0]; }
  double of(plant::Sensed signal, std::size_t muscle = 1) const { return sides[muscle == 2 ? 1 : 0][signal]; }
};

class Rider {
 public:
  /// All that changes on the way. `time_s`: of the instant it is at; `until_s`: of the next one.
  struct State {
    engine::Flow flow{};
    plant::Held held{};
    plant::Effects::Plays plays{}, opposite_plays{};
    Reading reading{};
    double time_s = 0.0, until_s = 0.0;
    Drive drive{};                                 ///< that was held last, pressures as they are
    PastCommands commands{}, opposite_commands{};  ///< where something makes them late
    Switches switches{}, opposite_switches{};      ///< of valves that are open or shut
    PastValues rises{};
    std::vector<PastValues> late{};  ///< of other sensors that are late, by muscle and signal
    bool reads = true;               ///< a law of the user's own may make no number of a reading

    /// All of the above in turn, for whoever writes a state down.
    static void members(auto& self, auto& visit) {
      visit(self.flow, self.held, self.plays, self.opposite_plays, self.reading, self.time_s, self.until_s,
            self.drive, self.commands, self.opposite_commands, self.switches, self.opposite_switches,
            self.rises, self.late, self.reads);
    }
  };

  explicit Rider(const Loaded& loaded) : plant_(plant::plant_of(loaded.rig, loaded.load_kg)) {}

  /// At rest, pressures as the drive asks for, the encoder at zero. A load may still sink onto the braid
  /// stop, a link swing to where the muscles hold it: the steps of the rig's settling time follow.
  void start(const Drive& given, double at_s);
  /// Throws std::invalid_argument where `until_s` is not later than the present instant.
  void hold(const Drive& given, double until_s);
  /// How far what is held goes: to the next instant, or before it a command that comes late is felt.
  double next_s() const;
  /// The flow has been carried so far; whether that is the next instant.
  bool arrive(double at_s);
  /// What the instruments see of the state as it is.
  void look();
  /// Throws engine::NumericalFailure if that is no number.
  void require_reading() const;

  /// Nothing has come or gone from here on.
  /// Of the joint's angle [rad/s], or of the contraction ratio [1/s].
  double speed() const {
    const auto& joint = now.flow.state.joint;
    return plant_.has_angle() ? plant_.angle_speed_rad_per_s(joint) : joint.contraction_speed_per_s;
  }
  void open_ledger() { now.flow.ledger = plant_.opened(now.flow.state, now.flow.memory); }

  const plant::Plant& plant() const { return plant_; }
  plant::Moment<double> moment() const { return plant_.moment(now.flow.state, now.flow.memory, now.held); }
  double cord_force_N(std::size_t muscle) const;  ///< of muscle 1 or 2 of a pair; else 0 or 1

  State now;

 private:
  void judge_slip();
  /// What a sensor on a muscle (1 or 2) shows of a value that it has now.
  double seen(plant::Sensed sensed, std::size_t muscle, double value);

  plant::Plant plant_;
};

/// Of riders in common steps: how far what they hold goes, and that they have been carried there; whether all
/// are at the next instant.
double next_s(std::span<const Rider> riders);
bool arrive(std::span<Rider> riders, double at_s);

}  // namespace mckibben::ride
