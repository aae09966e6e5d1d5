// Braid geometry: what follows from the threads' constant length alone. Thesis 2.4 to 2.10 and 4.3.
#pragma once

#include <plant/choose.hpp>
#include <plant/muscle.hpp>

namespace mckibben::plant {

/// How much of its length pulls.
template <class P>
P pulling_share(const MuscleOf<P>& muscle) {
  return 1.0 - muscle.end_length_m / muscle.rest_length_m;
}

/// Constants of a braid, computed once; of muscles side by side, of all of them together. All lengths in m,
/// areas in m2, volumes in m3.
template <class P>
class BraidOf {
 public:
  explicit BraidOf(const MuscleOf<P>& muscle);

  /// a (1 - k e)^2 - b, the bracket of T 2.8: braid force per area and pressure.
  /// Dimensionless; zero at e_max.
  template <class S>
  S pull_ratio(const S& contraction_ratio) const {
    const S u = 1.0 - k_ * contraction_ratio;
    return a_ * u * u - b_;
  }

  /// Tondu-Lopez braid force [N] at a gauge pressure [Pa] (T 2.8).
  template <class S>
  S force_N(const S& contraction_ratio, const S& pressure_Pa) const {
    return area_m2_ * pressure_Pa * pull_ratio(contraction_ratio);
  }

  /// The same with another end correction, k + shift.
  template <class S>
  S force_N(const S& contraction_ratio, const S& pressure_Pa, const S& end_correction_shift) const {
    const S u = 1.0 - (k_ + end_correction_shift) * contraction_ratio;
    return area_m2_ * pressure_Pa * (a_ * u * u - b_);
  }

  /// dV/de [m3], by virtual work: F l0 de = P dV, so that pneumatic work is mechanical work exactly.
  template <class S>
  S volume_slope_m3(const S& contraction_ratio) const {
    return length_m_ * area_m2_ * pull_ratio(contraction_ratio);
  }

  /// Gas volume [m3], the integral of the slope from A0 l0 plus the dead volume at e = 0.
  template <class S>
  S volume_m3(const S& contraction_ratio) const {
    const S u = 1.0 - k_ * contraction_ratio;
    return volume_at_rest_m3_ +
           length_m_ * area_m2_ * (a_ * (1.0 - u * u * u) / (3.0 * k_) - b_ * contraction_ratio);
  }

  /// Contact surface of the threads [m2] (T 4.3). Needs e > 1 - 1/cos(alpha0) (squared), see `in_domain`.
  template <class S>
  S contact_surface_m2(const S& contraction_ratio) const {
    using std::sqrt;
    const S shortened = 1.0 - contraction_ratio;
    const S root = sqrt(1.0 - surface_cosine_ * shortened * shortened);
    return surface_factor_m2_ / (shortened * root);
  }

  /// Whether the laws above are defined at this contraction ratio, and the volume is positive.
  auto in_domain(const P& contraction_ratio) const {
    return contraction_ratio > lowest_ratio_ && contraction_ratio < highest_ratio_;
  }

  double largest_contraction_ratio() const { return (1.0 - std::sqrt(b_ / a_)) / k_; }  ///< e_max (T 2.10)
  double largest_force_N(double pressure_Pa) const { return area_m2_ * pressure_Pa * (a_ - b_); }  ///< T 2.9
  /// Largest load [kg] that the taut threads bear: put on them at once it may stretch them by half of what
  /// lays them along the axis, where the laws end.
  double largest_load_kg() const {
    return -0.25 * lowest_ratio_ * length_m_ * stop_N_per_m_ / gravity_m_per_s2;
  }
  const P& rest_length_m() const { return length_m_; }
  const P& stop_stiffness_N_per_m() const { return stop_N_per_m_; }

 private:
  P a_, b_, k_, area_m2_, length_m_, volume_at_rest_m3_, stop_N_per_m_;
  P surface_factor_m2_, surface_cosine_, lowest_ratio_, highest_ratio_;
};
using Braid = BraidOf<double>;

template <class P>
BraidOf<P>::BraidOf(const MuscleOf<P>& muscle) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const P sine = sin(muscle.braid_angle_rad);
  const P cosine = cos(muscle.braid_angle_rad);
  a_ = 3.0 * cosine * cosine / (sine * sine);  // T 2.6
  b_ = 1.0 / (sine * sine);                    // T 2.7
  k_ = muscle.end_correction;
  const auto count = static_cast<double>(muscle.count);
  const P tube_m2 = count * std::numbers::pi * muscle.rest_radius_m * muscle.rest_radius_m;
  area_m2_ = tube_m2 * pulling_share(muscle);
  length_m_ = muscle.rest_length_m;
  stop_N_per_m_ = count * muscle.stop_stiffness_N_per_m;
  volume_at_rest_m3_ = count * muscle.dead_volume_m3 + tube_m2 * length_m_;
  surface_factor_m2_ = count * 2.0 * std::numbers::pi * muscle.rest_radius_m * length_m_ * sine;
  surface_cosine_ = muscle.contact_surface == ContactSurface::squared ? P(cosine * cosine) : cosine;
  lowest_ratio_ = 1.0 - 1.0 / sqrt(surface_cosine_);
  highest_ratio_ = 1.0 / k_;  // beyond it the braid law turns back; the volume is positive up to here
  // Where the volume would end before, by bisection.
  const auto empty_there = volume_m3(lowest_ratio_) <= 0.0;
  P empty = lowest_ratio_, filled = P(0.0);
  while (any(empty_there && filled - empty >= 1e-9)) {
    const P middle = 0.5 * (empty + filled);
    const auto positive = volume_m3(middle) > 0.0;
    filled = select(positive, middle, filled);
    empty = select(positive, empty, middle);
  }
  lowest_ratio_ = select(empty_there, filled, lowest_ratio_);
}

/// Above this contraction the muscle may be damaged (T 2.3).
inline constexpr double risky_contraction_ratio = 0.20;

/// What a contraction means for the muscle: nothing, a risk of damage, or that no real muscle reaches it
/// (T 2.3, 2.10).
enum class Danger { safe, risk, impossible };
inline Danger danger_of(const Muscle& muscle, double contraction_ratio) {
  if (contraction_ratio > Braid(muscle).largest_contraction_ratio()) return Danger::impossible;
  return contraction_ratio > risky_contraction_ratio ? Danger::risk : Danger::safe;
}

}  // namespace mckibben::plant
