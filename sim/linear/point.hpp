// The rig at rest under a command, and its slopes there (engine::linearise). It stands where it would without
// friction, in the middle of the band in which friction holds it. Where a law has a kink, what is taken is
// the mean of both sides: of threads at standstill, and of a servo valve that is shut.
//
// A bristle (LuGre) has no state of its own here. Threads that stick are springs, z = l0 e and what the cord
// stretches. Threads that slide pull alike at any speed and have no slope; but in a swing whose speed has the
// amplitude V, dry friction G damps as 4 G/(pi V) does (describing function; Gelb & Vander Velde 1968).
#pragma once

#include <array>
#include <stdexcept>

#include <controllers/controller.hpp>
#include <plant/rig.hpp>
#include <sim/engine/linear.hpp>
#include <sim/linear/system.hpp>

namespace mckibben::linear {

enum class Threads { sliding, sticking };
/// Which way a servo valve that is shut opens.
enum class Opening { both, filling, venting };

struct Place {
  enum class Of { middle, command, pressure, position };
  Of of = Of::middle;  ///< of the commands to which the valve answers
  double value =
      0.0;  ///< command, pressure of (the first) muscle [Pa], contraction ratio or joint angle [rad]
};

struct Point {
  double load_kg = 0.0;
  controllers::Command command{};
  double position = 0.0;  ///< contraction ratio or joint angle [rad]
  std::array<double, 2> pressure_Pa{};
  bool has_angle = false, settled = true, on_stop = false, shut = false;
  /// States without bristles; commands as inputs; position and muscle pressures as outputs.
  engine::Linear slopes;
  /// What a loop's output does to the commands: of a pair the second muscle is vented as the first is filled.
  Eigen::VectorXd direction;
  Matrix dry;          ///< of threads that slide, and the load's guide: A loses 4/(pi V) of it in a swing
  double shown = 1.0;  ///< what is read for a unit of position
  double command_delay_s = 0.0, reading_delay_s = 0.0;
  double friction_N = 0.0;  ///< at the cord: what friction holds, either way

  double delay_s() const { return command_delay_s + reading_delay_s; }
  /// From a loop's output to one of the outputs; states in their working sizes, delays left out.
  System system(Eigen::Index output = 0) const;
  /// Where the load (of a pair the cords) swings with a speed of that amplitude.
  Point swinging(double speed_m_per_s) const;
  /// Working sizes of the states: what is one there.
  Eigen::VectorXd sizes() const;
};

/// Commands of a rig whose (first) muscle has this one; the opposite one of a pair has a pressure as far
/// below the middle of the valves' lines as the first is above it.
controllers::Command commands_of(const plant::Rig& rig, double current_mA);

/// The rig has no such place.
struct OutOfReach : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Settles there from rest. Throws OutOfReach, std::invalid_argument where the rig has no
/// slopes, NumericalFailure.
Point point_at(const plant::Rig& rig, double load_kg, const Place& place, Threads threads, Opening opening);

}  // namespace mckibben::linear
