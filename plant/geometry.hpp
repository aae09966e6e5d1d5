// Braid geometry: what follows from the threads' constant length alone. Thesis 2.4 to 2.10 and 4.3.
#pragma once

#include <plant/rig.hpp>

namespace mckibben::plant {

/// Constants of a braid, computed once. All lengths in m, areas in m2, volumes in m3.
class Braid {
 public:
  explicit Braid(const Muscle& muscle);

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
  bool in_domain(double contraction_ratio) const {
    return contraction_ratio > lowest_ratio_ && contraction_ratio < highest_ratio_;
  }

  double largest_contraction_ratio() const { return (1.0 - std::sqrt(b_ / a_)) / k_; }  ///< e_max (T 2.10)
  double largest_force_N(double pressure_Pa) const { return area_m2_ * pressure_Pa * (a_ - b_); }  ///< T 2.9
  /// Largest load [kg] that the taut threads bear: put on them at once it may stretch them by half of what
  /// lays them along the axis, where the laws end.
  double largest_load_kg() const {
    return -0.25 * lowest_ratio_ * length_m_ * stop_N_per_m_ / gravity_m_per_s2;
  }
  double rest_length_m() const { return length_m_; }

 private:
  double a_, b_, k_, area_m2_, length_m_, volume_at_rest_m3_, stop_N_per_m_;
  double surface_factor_m2_, surface_cosine_, lowest_ratio_, highest_ratio_;
};

/// Above this contraction the muscle may be damaged (T 2.3).
inline constexpr double risky_contraction_ratio = 0.20;

/// What a contraction means for the muscle: nothing, a risk of damage, or that no real muscle reaches it
/// (T 2.3, 2.10).
enum class Verdict { safe, risk, impossible };
inline Verdict verdict_on(const Muscle& muscle, double contraction_ratio) {
  if (contraction_ratio > Braid(muscle).largest_contraction_ratio()) return Verdict::impossible;
  return contraction_ratio > risky_contraction_ratio ? Verdict::risk : Verdict::safe;
}

}  // namespace mckibben::plant
