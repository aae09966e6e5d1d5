// Angles as contraction ratios; see the header.
#include <algorithm>
#include <stdexcept>

#include <controllers/angle_terms.hpp>

namespace mckibben::controllers {

double ratio_per_rad(const Knowledge& known) {
  if (!(known.wheel_radius_m > 0.0)) throw std::invalid_argument("a hanging load has no angle");
  return known.wheel_radius_m / known.model.rest_length_m;
}

std::optional<double> AngleTerms::fastest_load_per_s(const Knowledge& known) const {
  if (!fastest_joint_rad_per_s) return std::nullopt;
  return *fastest_joint_rad_per_s * ratio_per_rad(known);
}

Knowledge AngleTerms::within_angles(Knowledge known) const {
  const double per_rad = ratio_per_rad(known);
  for (double& ratio : known.target) {
    if (lowest_angle_rad) ratio = std::max(ratio, *lowest_angle_rad * per_rad);
    if (highest_angle_rad) ratio = std::min(ratio, *highest_angle_rad * per_rad);
  }
  return known;
}

}  // namespace mckibben::controllers
