// Constants of the braid; see the header for the laws.
#include <plant/geometry.hpp>

namespace mckibben::plant {

Braid::Braid(const Muscle& muscle) {
  const double sine = std::sin(muscle.braid_angle_rad);
  const double cosine = std::cos(muscle.braid_angle_rad);
  a_ = 3.0 * cosine * cosine / (sine * sine);  // T 2.6
  b_ = 1.0 / (sine * sine);                    // T 2.7
  k_ = muscle.end_correction;
  area_m2_ = std::numbers::pi * muscle.rest_radius_m * muscle.rest_radius_m;
  length_m_ = muscle.rest_length_m;
  stop_N_per_m_ = muscle.stop_stiffness_N_per_m;
  volume_at_rest_m3_ = muscle.dead_volume_m3 + area_m2_ * length_m_;
  surface_factor_m2_ = 2.0 * std::numbers::pi * muscle.rest_radius_m * length_m_ * sine;
  surface_cosine_ = muscle.contact_surface == ContactSurface::squared ? cosine * cosine : cosine;
  lowest_ratio_ = 1.0 - 1.0 / std::sqrt(surface_cosine_);
  highest_ratio_ = 1.0 / k_;  // beyond it the braid law turns back; the volume is positive up to here
  for (double empty = lowest_ratio_, filled = 0.0; volume_m3(lowest_ratio_) <= 0.0;) {
    const double middle = 0.5 * (empty + filled);
    (volume_m3(middle) > 0.0 ? filled : empty) = middle;
    if (filled - empty < 1e-9) lowest_ratio_ = filled;
  }
}

}  // namespace mckibben::plant
