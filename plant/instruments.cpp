// Instruments; see the header.
#include <algorithm>
#include <cmath>

#include <plant/instruments.hpp>

namespace mckibben::plant {

double dac_output_mA(const Dac& dac, double wanted_mA) {
  const double step = dac.largest_current_mA / std::ldexp(1.0, dac.bits);
  const double clamped = std::clamp(wanted_mA, 0.0, dac.largest_current_mA);
  return std::min(std::round(clamped / step) * step, dac.largest_current_mA);
}

double count_height_m(const Encoder& encoder, const Joint& joint) {
  const double turns_per_count = 1.0 / (encoder.pulses_per_turn * encoder.wheel_ratio);
  return joint.wheel_radius_m * 2.0 * std::numbers::pi * turns_per_count;
}

std::int64_t PulseCounter::count(double x_m) {
  const auto edges_below = [this](double height_m, double phase) {
    return static_cast<std::int64_t>(std::floor(height_m / q_m_ - phase));
  };
  if (wiring_ == EncoderWiring::ideal) return edges_below(x_m, 0.0);
  const double phase = x_m > last_m_ ? 0.25 : 0.5;  // B's rising edge going up, A's going down
  counts_ += edges_below(x_m, phase) - edges_below(last_m_, phase);
  last_m_ = x_m;
  return counts_;
}

std::int64_t PositionReader::count(double x_m) {
  if (sensor_.absent()) return counter_.count(x_m);
  double steps = x_m / step_m_;
  if (sensor_.lowest) steps = std::max(steps, *sensor_.lowest / sensor_.resolution);
  if (sensor_.highest) steps = std::min(steps, *sensor_.highest / sensor_.resolution);
  return std::llround(steps);
}

double middle_of_count(const Sensor& sensor) {
  return sensor.absent() ? 0.5 : 0.0;
}

double cell_reading_N(const LoadCell& cell, double force_N, double noise_N) {
  double read_N = std::max(force_N, 0.0) + noise_N;
  if (cell.highest_N) read_N = std::min(read_N, *cell.highest_N);
  return cell.resolution_N > 0.0 ? std::round(read_N / cell.resolution_N) * cell.resolution_N : read_N;
}

double gauge_reading_Pa(const Gauge& gauge, double pressure_Pa) {
  if (gauge.resolution_Pa <= 0.0) return pressure_Pa;
  return std::round(pressure_Pa / gauge.resolution_Pa) * gauge.resolution_Pa;
}

}  // namespace mckibben::plant
