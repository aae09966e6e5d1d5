// What every controller is: encoder counts in, command out (two where there are two muscles), once each tick.
// A controller knows the hardware only by its data sheet (`Knowledge`); true states and the plant's own code
// are out of its sight.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <controllers/reach.hpp>

namespace mckibben::controllers {

/// Times closer than this are one instant: k * tick_s may miss a written time by rounding.
inline constexpr double instant_s = 1e-9;

/// Standard gravity.
inline constexpr double gravity_m_per_s2 = 9.80665;

/// What the hardware shows at tick k, at k * tick_s.
struct Reading {
  std::int64_t tick = 0;
  double time_s = 0.0;
  std::int64_t counts = 0;
};

/// What the controller asks of the DAC until the next tick.
struct Command {
  double current_mA = 0.0;
  double opposite_mA = 0.0;  ///< to the valve of muscle 2 of a pair
};

/// Nominal braid: force (T 2.8, 4.30) F = pi r0^2 P [a (1 - k e)^2 - b], and contact surface (T 4.3).
struct ForceModel {
  double rest_radius_m = 0.0;
  double rest_length_m = 0.0;
  double braid_angle_rad = 0.0;
  double end_correction = 0.0;
  bool surface_as_printed = false;  ///< T 4.3 as printed, without the square on its cosine
  int count = 1;                    ///< such muscles side by side: force and surface are of all of them

  double force_N(double contraction_ratio, double pressure_Pa) const;
  double force_drop_N(double contraction_ratio, double pressure_Pa) const;  ///< -dF/de
  double contact_surface_m2(double contraction_ratio) const;
  double largest_contraction_ratio() const;  ///< e_max (T 2.10)
};

/// Nominal line of the servo valve, from command to gauge pressure (T 3.2).
struct ValveLine {
  double zero_current_mA = 0.0;
  double span_current_mA = 0.0;
  double zero_pressure_Pa = 0.0;
  double span_pressure_Pa = 0.0;
  std::string_view unit = "mA";               ///< of the commands: mA, V or bar
  std::optional<double> closed_current_mA{};  ///< at which it neither fills nor vents; not of all valves

  double slope_Pa_per_mA() const;
  double pressure_Pa(double current_mA) const;  ///< kept between its ends
  double current_mA(double pressure_Pa) const;  ///< kept between its ends
};

/// The second muscle of a pair, and how both pull on the joint (T 2.7).
struct PairKnowledge {
  ForceModel opposite;
  ValveLine opposite_valve;
  double mounted_ratio = 0.0, opposite_mounted_ratio = 0.0;  ///< e10, e20
  /// Stiffness of the joint wanted at each tick, its last value after it; empty if none is asked for.
  std::vector<double> stiffness_N_m_per_rad;
};

/// What a controller is told on paper before the run. Contraction ratios are of muscle 1; of a pair or a
/// lever they count from joint angle 0: R theta/l0.
struct Knowledge {
  double contraction_per_count = 0.0;
  double middle_of_count = 0.5;  ///< counts by which a position is more than its reading, on average
  double tick_s = 0.0;
  double largest_current_mA = 0.0;  ///< top of the DAC's range
  std::vector<double> target;       ///< contraction ratio wanted at each tick; its last value holds after it
  ForceModel model;
  ValveLine valve;
  std::optional<double> load_kg{};  ///< that hangs; for controllers that ask to be told
  Reach reach;                      ///< what the hardware can follow; empty where nobody computed it
  double wheel_radius_m = 0.0;      ///< R, where the joint's angle is read; 0 of a hanging load
  std::optional<PairKnowledge> pair{};

  /// Contraction ratio wanted at `tick`; 0 where there is no target.
  double target_at(std::int64_t tick) const;
};

/// Something a controller found out about its load or its own limits.
struct Finding {
  std::string name;
  std::string unit;  ///< of commands, here and in the name, as they are in mA
  double value = 0.0;
};

/// The value of the finding of that name; 0 if there is none.
double value_of(const std::vector<Finding>& findings, std::string_view name);

/// A controller cannot do its work: the load does not move, or lies outside what it was calibrated for.
class ControllerFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Controller {
 public:
  Controller() = default;
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  virtual ~Controller();

  /// Current held while the rig settles, before the first reading.
  virtual Command rest() = 0;

  /// Ticks it needs after settling and before tick 0, to find out about its load. They are not recorded.
  virtual std::int64_t preparation_ticks() const { return 0; }

  /// Called once for each tick, in order, beginning with tick -preparation_ticks(). Throws ControllerFailure.
  virtual Command step(const Reading& reading) = 0;

  /// What it found out, once its last step is done.
  virtual std::vector<Finding> findings() const { return {}; }

  /// True if the currents are already what a DAC gave and must not be rounded again.
  virtual bool already_quantised() const { return false; }
};

}  // namespace mckibben::controllers
