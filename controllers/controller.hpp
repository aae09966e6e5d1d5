// What every controller is: encoder counts in, current out, once each tick. A controller knows the hardware
// only by its data sheet (`Knowledge`); true states and the plant's own code are out of its sight.
#pragma once

#include <cstdint>
#include <vector>

namespace mckibben::controllers {

/// Times closer than this are one instant: k * tick_s may miss a written time by rounding.
inline constexpr double instant_s = 1e-9;

/// What the hardware shows at tick k, at k * tick_s.
struct Reading {
  std::int64_t tick = 0;
  double time_s = 0.0;
  std::int64_t counts = 0;
};

/// What the controller asks of the DAC until the next tick.
struct Command {
  double current_mA = 0.0;
};

/// Nominal braid force law (T 2.8): F = pi r0^2 P [a (1 - k e)^2 - b].
struct ForceModel {
  double rest_radius_m = 0.0;
  double rest_length_m = 0.0;
  double braid_angle_rad = 0.0;
  double end_correction = 0.0;
};

/// Nominal line of the servo valve, from current to gauge pressure (T 3.2).
struct ValveLine {
  double zero_current_mA = 0.0;
  double span_current_mA = 0.0;
  double zero_pressure_Pa = 0.0;
  double span_pressure_Pa = 0.0;
};

/// What a controller is told on paper before the run.
struct Knowledge {
  double contraction_per_count = 0.0;
  double tick_s = 0.0;
  double largest_current_mA = 0.0;  ///< top of the DAC's range
  std::vector<double> target;       ///< contraction ratio wanted at each tick; its last value holds after it
  ForceModel model;
  ValveLine valve;

  /// Contraction ratio wanted at `tick`; 0 where there is no target.
  double target_at(std::int64_t tick) const;
};

class Controller {
 public:
  Controller() = default;
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  virtual ~Controller();

  /// Current held while the rig settles, before the first reading.
  virtual Command rest() = 0;

  /// Called once for each tick, in order, beginning with tick 0.
  virtual Command step(const Reading& reading) = 0;

  /// True if the currents are already what a DAC gave and must not be rounded again.
  virtual bool already_quantised() const { return false; }
};

}  // namespace mckibben::controllers
