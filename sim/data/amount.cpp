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

std::string amount_of(Judged judged, double value, const plant::Rig& rig, int digits) {
  switch (judged) {
    case Judged::force:
      return shown(value, digits) + " N";
    case Judged::angle:
      return shown(value / plant::degree_rad, digits) + " deg";
    case Judged::pressure:
      return std::abs(value) < 1e4 ? shown(1e3 * value / plant::Pa_per_bar, digits) + " mbar"
                                   : shown(value / plant::Pa_per_bar, digits) + " bar";
    case Judged::contraction:
      break;
  }
  return shown(1e3 * value * rig.muscle.rest_length_m, digits) + " mm";
}

std::string_view unit_in_words(Judged judged) {
  switch (judged) {
    case Judged::force:
      return "N";
    case Judged::angle:
      return "rad";
    case Judged::pressure:
      return "Pa";
    case Judged::contraction:
      break;
  }
  return "in contraction ratio";
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
