// What stands between plant and controller: digital-to-analogue converter, encoder, pressure gauge (T 3.1).
#pragma once

#include <cstdint>

#include <plant/rig.hpp>

namespace mckibben::plant {

/// What disturbs instruments and valve: white Gaussian noise by its root mean square, and two slow
/// disturbances of the reference pressure, a sine and an Ornstein-Uhlenbeck process (Uhlenbeck & Ornstein,
/// Phys. Rev. 36 (1930) 823-841). Those of size zero draw nothing.
struct Noise {
  double encoder_jitter = 0.0;
  double gauge_Pa = 0.0;
  double current_mA = 0.0;
  double ripple_Pa = 0.0, ripple_period_s = 7.0;
  double wander_Pa = 0.0, wander_time_s = 5.0;

  static void fields(auto& self, auto& visit) {
    visit("encoder_jitter", self.encoder_jitter, "1", 0.0, 0.1,
          "rms of the position before it is counted, as contraction ratio");
    visit("gauge", self.gauge_Pa, "Pa", 0.0, 1e5, "rms of the pressure gauge");
    visit("current", self.current_mA, "mA", 0.0, 10.0,
          "rms of the command that reaches the valve; not recorded");
    visit("ripple", self.ripple_Pa, "Pa", 0.0, 1e5,
          "amplitude of a sine on the valve's reference pressure, its phase by chance");
    visit("ripple_period", self.ripple_period_s, "s", 0.1, 1e4, "its period");
    visit("wander", self.wander_Pa, "Pa", 0.0, 1e5,
          "rms of a slow random wander of the valve's reference pressure");
    visit("wander_time", self.wander_time_s, "s", 0.1, 1e4, "time after which 1/e of a deviation is left");
  }
};

/// The command a DAC gives when asked for one: clamped to its range, rounded to the nearest step.
double dac_output_mA(const Dac& dac, double wanted_mA);

/// Rise of the load for one count of what reads the position [m]: of an encoder, or a step of another sensor.
double count_height_m(const Sensor& position, double wheel_radius_m);
inline double count_height_m(const Rig& rig) {
  return count_height_m(rig.sensors.position(), rig.joint.wheel_radius_m);
}

/// A pulse counter on the encoder.
///
/// `ideal` counts floor(x / q). `crosswise` is the thesis's wiring: channel A drives the first counter and
/// gates the second, B the other way round. Going up, B's rising edges count, a quarter cycle after A's;
/// going down, A's, which then stand half a cycle further: so there is a play of a quarter count, and a load
/// that trembles across the edge at the quarter cycle is counted up
/// again and again without ever being counted down.
class PulseCounter {
 public:
  /// Counters reset with the load at x = 0. `q` is the rise for one count [m].
  PulseCounter(EncoderWiring wiring, double count_height_m) : wiring_(wiring), q_m_(count_height_m) {}

  /// Counts at a rise x [m], reached from the last one without turning on the way.
  std::int64_t count(double x_m);

  /// What changes of it: a saved state's.
  static void members(auto& self, auto& visit) { visit(self.last_m_, self.counts_); }

 private:
  EncoderWiring wiring_;
  double q_m_;
  double last_m_ = 0.0;
  std::int64_t counts_ = 0;
};

/// What reads the joint's position, in counts from rest: the encoder's pulses, or whole steps of a sensor.
class PositionReader {
 public:
  explicit PositionReader(const Rig& rig)
      : sensor_(rig.sensors.position()), step_m_(count_height_m(rig)), counter_(sensor_.wiring, step_m_) {}

  /// At a rise x [m], reached from the last one without turning on the way.
  std::int64_t count(double x_m);

  static void members(auto& self, auto& visit) { visit(self.counter_); }

 private:
  Sensor sensor_;
  double step_m_;
  PulseCounter counter_;
};

/// By how much more than its count a reading stands for, in counts: a counter rounds down, another sensor to
/// the nearest.
double middle_of_count(const Sensor& position);

/// What a sensor shows of a value with its noise in it; the value itself where there is no sensor.
double shown(const Sensor* sensor, double value);

}  // namespace mckibben::plant
