// See the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <plant/instruments.hpp>
#include <sim/data/amount.hpp>
#include <sim/data/thresholds.hpp>

namespace mckibben::data {
namespace {

constexpr double noises_in_a_grain = 4.0;

/// From 10 on with a decimal more: 12.6 is not told as 13.
std::string shown(double value, int digits) {
  return fmt::format("{:.{}g}", value, std::abs(value) >= 10.0 ? digits + 1 : digits);
}

}  // namespace

Shown shown_in(Judged judged, const plant::Rig& rig) {
  switch (judged) {
    case Judged::force:
      return {"N", 1.0, 3};
    case Judged::angle:
      return {"deg", plant::degree_rad, 4};
    case Judged::pressure:
      return {"mbar", 1e-3 * plant::Pa_per_bar, 3};
    case Judged::contraction:
      break;
  }
  return {"mm", 1e-3 / rig.muscle.rest_length_m, 3};
}

std::string amount_of(Judged judged, double value, const plant::Rig& rig, int digits) {
  if (judged == Judged::pressure && std::abs(value) >= 1e4)
    return shown(value / plant::Pa_per_bar, digits) + " bar";
  const Shown in = shown_in(judged, rig);
  return shown(value / in.size, digits) + ' ' + std::string(in.unit);
}

std::string_view si_unit(const plant::Signal& signal) {
  return signal.unit.name == plant::units::bar.name ? "Pa" : signal.unit.name;
}

double reading_per_count(const plant::Rig& rig) {
  if (!rig.has_angle()) return plant::count_height_m(rig) / rig.muscle.rest_length_m;
  return plant::count_height_m(rig) / rig.joint.wheel_radius_m;
}

double reading_grain(domain::Judged judged, const plant::Rig& rig) {
  if (judged == domain::Judged::pressure) return thresholds.reading.gauge_step_Pa;
  const double count = reading_per_count(rig);
  const plant::Sensor& sensor = rig.sensors.position();
  if (sensor.counts_pulses()) return count;
  const double usual_m = plant::count_height_m(plant::Sensor{}, rig.joint.wheel_radius_m);
  return count / plant::count_height_m(rig) *
         std::max({plant::count_height_m(rig), usual_m,
                   noises_in_a_grain * sensor.noise * sensor.rise_m(rig.joint.wheel_radius_m)});
}

}  // namespace mckibben::data
