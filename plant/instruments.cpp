// Instruments; see the header.
#include <algorithm>
#include <cmath>

#include <plant/instruments.hpp>

namespace mckibben::plant {

double dac_output_mA(const Dac& dac, double wanted_mA) {
  const double range = dac.largest_command - dac.lowest_command, step = range / std::ldexp(1.0, dac.bits);
  const double above = std::clamp(wanted_mA, dac.lowest_command, dac.largest_command) - dac.lowest_command;
  return dac.lowest_command + std::min(std::round(above / step) * step, range);
}

double count_height_m(const Sensor& position, double wheel_radius_m) {
  if (!position.counts_pulses()) return position.resolution * position.rise_m(wheel_radius_m);
  const double turns_per_count = 1.0 / (position.pulses_per_turn * position.wheel_ratio);
  return wheel_radius_m * 2.0 * std::numbers::pi * turns_per_count;
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
  if (sensor_.counts_pulses()) return counter_.count(x_m);
  double steps = x_m / step_m_;
  if (sensor_.lowest) steps = std::max(steps, *sensor_.lowest / sensor_.resolution);
  if (sensor_.highest) steps = std::min(steps, *sensor_.highest / sensor_.resolution);
  return std::llround(steps);
}

double middle_of_count(const Sensor& position) {
  return position.counts_pulses() ? 0.5 : 0.0;
}

double shown(const Sensor* sensor, double value) {
  if (sensor == nullptr) return value;
  if (sensor->lowest) value = std::max(value, *sensor->lowest);
  if (sensor->highest) value = std::min(value, *sensor->highest);
  return sensor->resolution > 0.0 ? std::round(value / sensor->resolution) * sensor->resolution : value;
}

}  // namespace mckibben::plant
