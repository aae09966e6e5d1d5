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

}  // namespace

std::string amount_of(Judged judged, double value, const plant::Rig& rig, int digits) {
  switch (judged) {
    case Judged::force:
      return fmt::format("{:.{}g} N", value, digits);
    case Judged::angle:
      return fmt::format("{:.{}g} deg", value / plant::degree_rad, digits);
    case Judged::pressure:
      return std::abs(value) < 1e4 ? fmt::format("{:.{}g} mbar", 1e3 * value / plant::Pa_per_bar, digits)
                                   : fmt::format("{:.{}g} bar", value / plant::Pa_per_bar, digits);
    case Judged::contraction:
      break;
  }
  return fmt::format("{:.{}g} mm", 1e3 * value * rig.muscle.rest_length_m, digits);
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

std::pair<std::string, std::string_view> told(domain::Beside which, bool pair) {
  return {domain::channel_of(which, pair).key_in_dataset(), which == domain::Beside::force ? "N" : "Pa"};
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
