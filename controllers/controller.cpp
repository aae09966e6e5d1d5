// What all controllers share: the nominal laws on the data sheet.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <controllers/controller.hpp>

namespace mckibben::controllers {
namespace {

double square(double value) {
  return value * value;
}

}  // namespace

double value_of(const std::vector<Finding>& findings, std::string_view name) {
  const auto is_it = [name](const Finding& one) { return one.name == name; };
  const auto found = std::find_if(findings.begin(), findings.end(), is_it);
  return found == findings.end() ? 0.0 : found->value;
}

Controller::~Controller() = default;

double Knowledge::target_at(std::int64_t tick) const {
  if (target.empty()) return 0.0;
  const auto last = static_cast<std::int64_t>(target.size()) - 1;
  return target[static_cast<std::size_t>(std::clamp<std::int64_t>(tick, 0, last))];
}

double ForceModel::force_N(double contraction_ratio, double pressure_Pa) const {
  const double a = 3.0 / square(std::tan(braid_angle_rad)), b = 1.0 / square(std::sin(braid_angle_rad));
  const double area_m2 = count * std::numbers::pi * square(rest_radius_m);
  return area_m2 * pressure_Pa * (a * square(1.0 - end_correction * contraction_ratio) - b);
}

double ForceModel::force_drop_N(double contraction_ratio, double pressure_Pa) const {
  const double a = 3.0 / square(std::tan(braid_angle_rad));
  const double area_m2 = count * std::numbers::pi * square(rest_radius_m);
  return area_m2 * pressure_Pa * 2.0 * a * end_correction * (1.0 - end_correction * contraction_ratio);
}

double ForceModel::contact_surface_m2(double contraction_ratio) const {
  const double cosine = std::cos(braid_angle_rad), shortened = 1.0 - contraction_ratio;
  const double factor = surface_as_printed ? cosine : square(cosine);  // docs/equations.md, Misprint
  return 2.0 * count * std::numbers::pi * rest_radius_m * rest_length_m * std::sin(braid_angle_rad) /
         (shortened * std::sqrt(1.0 - factor * square(shortened)));
}

double ForceModel::largest_contraction_ratio() const {
  return (1.0 - 1.0 / (std::sqrt(3.0) * std::cos(braid_angle_rad))) / end_correction;
}

double ValveLine::slope_Pa_per_mA() const {
  return (span_pressure_Pa - zero_pressure_Pa) / (span_current_mA - zero_current_mA);
}

double ValveLine::pressure_Pa(double current_mA) const {
  const double share = (current_mA - zero_current_mA) / (span_current_mA - zero_current_mA);
  return std::lerp(zero_pressure_Pa, span_pressure_Pa, std::clamp(share, 0.0, 1.0));
}

double ValveLine::current_mA(double pressure_Pa) const {
  const double share = (pressure_Pa - zero_pressure_Pa) / (span_pressure_Pa - zero_pressure_Pa);
  return std::lerp(zero_current_mA, span_current_mA, std::clamp(share, 0.0, 1.0));
}

}  // namespace mckibben::controllers
