// A lever that one muscle turns: a forearm, a finger, a leg. Its cord pulls at an arm that changes with the
// angle.
//
//   theta   joint angle, 0 as the muscle is mounted; grows as it contracts
//   x       rise of the cord, 0 at theta = 0            r = dx/dtheta > 0   the arm
//
// Attachment points at distances a (base) and b (lever) from the pivot, seen from there under the angle
// phi = opening - theta, are c apart:
//   c^2 = a^2 + b^2 - 2 a b cos(phi)      x = c(0) - c      r = a b sin(phi)/c
// In a table, r is straight between its points; r^2 is then straight over x. docs/equations.md, A lever.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include <plant/choose.hpp>
#include <plant/constants.hpp>
#include <plant/spring.hpp>

namespace mckibben::plant {

/// Whether what hangs on a lever has weight.
enum class Plane { vertical, horizontal };
constexpr auto names(Plane) {
  using enum Plane;
  return std::array{std::pair{vertical, std::string_view{"vertical"}},
                    std::pair{horizontal, std::string_view{"horizontal"}}};
}

/// A line of a table of arms.
template <class P>
struct ArmAtOf {
  P angle_rad = 0.0, arm_m = 0.03;

  static void fields(auto& self, auto& visit) {
    visit.required("angle", self.angle_rad, "rad", -180.0 * degree_rad, 180.0 * degree_rad, "joint angle");
    visit.required("arm", self.arm_m, "m", 1e-3, 5.0, "the cord's arm there");
  }
};

/// The lever, where its muscle pulls, and what it carries.
template <class P>
struct LeverOf {
  static constexpr std::string_view kind = "lever";

  P contraction_ratio = 0.0;  ///< e0: mounted so, at theta = 0
  P base_m = 0.30, attached_m = 0.05, opening_rad = 150.0 * degree_rad;
  std::vector<ArmAtOf<P>> arms;  ///< in place of these
  P mass_kg = 1.0, centre_m = 0.15, inertia_kg_m2 = 0.03;
  P load_at_m = 0.30;
  Plane plane = Plane::vertical;
  P hangs_at_rad = -30.0 * degree_rad;
  P damping_N_m_s_per_rad = 0.05;
  P spring_N_m_per_rad = 0.0, spring_preload_N_m = 0.0;
  SpringWays spring_ways = SpringWays::both;

  bool absent() const { return false; }
  SpringOf<P> spring() const { return {spring_preload_N_m, spring_N_m_per_rad, spring_ways}; }
  bool by_points() const { return arms.empty(); }

  static void fields(auto& self, auto& visit) {
    visit("contraction", self.contraction_ratio, "1", 0.0, 0.5, "of the muscle at joint angle 0, e0");
    visit("base_distance", self.base_m, "m", 1e-3, 5.0, "pivot to the muscle's fixed end, a");
    visit("lever_distance", self.attached_m, "m", 1e-3, 5.0, "pivot to the point that the cord pulls, b");
    visit("opening", self.opening_rad, "rad", 1.0 * degree_rad, 179.0 * degree_rad,
          "between these points, seen from the pivot, at joint angle 0");
    visit("arms", self.arms, "in place of these three: the arm over the angle, straight between lines");
    visit("mass", self.mass_kg, "kg", 0.0, 500.0, "of the lever");
    visit("centre", self.centre_m, "m", 0.0, 5.0, "pivot to its centre of mass");
    visit("inertia", self.inertia_kg_m2, "kg.m2", 1e-6, 1e3,
          "about the pivot, without load; wheel_inertia is added");
    visit("load_at", self.load_at_m, "m", 0.0, 5.0, "pivot to the load, in line with the centre");
    visit("plane", self.plane, "in which it turns; horizontal: without weight");
    visit("hangs_at", self.hangs_at_rad, "rad", -180.0 * degree_rad, 180.0 * degree_rad,
          "joint angle at which it hangs straight down");
    visit("damping", self.damping_N_m_s_per_rad, "N.m.s/rad", 0.0, 1e3, "of the joint, c_j");
    visit("spring", self.spring_N_m_per_rad, "N.m/rad", 0.0, 1e5, "about the pivot");
    visit("spring_preload", self.spring_preload_N_m, "N.m", -1e4, 1e4, "its torque at joint angle 0");
    visit("spring_ways", self.spring_ways, "one: it only pulls");
  }
  void rules(auto& report) const {
    if (inertia_kg_m2 < mass_kg * centre_m * centre_m)
      report("inertia", "about the pivot it is at least mass centre^2 (parallel axes)");
    for (std::size_t i = 1; i < arms.size(); ++i)
      if (arms[i].angle_rad <= arms[i - 1].angle_rad) report("arms", "angles must ascend from line to line");
  }
};
using Lever = LeverOf<double>;

/// How a lever stands where its cord has risen so far.
template <class S>
struct Stand {
  S angle_rad;    ///< theta
  S arm_m;        ///< r
  S arm_slope_m;  ///< dr/dtheta
};

/// From the rise of the cord to the lever, and back. Computed once.
template <class P>
class TurningOf {
 public:
  explicit TurningOf(const LeverOf<P>& lever)
      : a_(lever.base_m),
        b_(lever.attached_m),
        opening_rad_(lever.opening_rad),
        opened_m_(distance_m(P(0.0))),
        table_(lever.arms) {
    for (std::size_t i = 0; i < table_.size(); ++i)
      risen_m_.push_back(i == 0 ? P(0.0)
                                : risen_m_[i - 1] + 0.5 * (table_[i].arm_m + table_[i - 1].arm_m) *
                                                        (table_[i].angle_rad - table_[i - 1].angle_rad));
    if (table_.empty()) return;
    const P at_zero_m = rise_m(P(0.0));
    for (P& each : risen_m_) each = each - at_zero_m;
  }

  template <class S>
  Stand<S> at(const S& rise_m) const {
    return table_.empty() ? by_points(rise_m) : by_table(rise_m);
  }
  /// Whether there is an arm: points and pivot are not in line, as within 2.6 deg they count to be.
  auto in_domain(const P& rise_m) const {
    if (!table_.empty()) return squared_arm_m2(rise_m) > 0.0;
    const P c = opened_m_ - rise_m, cosine = cosine_of(c);
    return c > 0.0 && cosine < straightest && cosine > -straightest;
  }
  /// x at an angle.
  P rise_m(const P& angle_rad) const {
    if (table_.empty()) return opened_m_ - distance_m(angle_rad);
    P rise = P(0.0);
    for (std::size_t i = 0; i < lines(); ++i) {
      const P on_rad = angle_rad - table_[i].angle_rad;
      const P here = risen_m_[i] + (table_[i].arm_m + 0.5 * slope_m(i) * on_rad) * on_rad;
      rise = i == 0 ? here : select(on_rad > 0.0, here, rise);
    }
    return rise;
  }
  /// Between the attachment points.
  P distance_m(const P& angle_rad) const {
    using std::cos;
    using std::sqrt;
    return sqrt(a_ * a_ + b_ * b_ - 2.0 * a_ * b_ * cos(opening_rad_ - angle_rad));
  }

 private:
  static constexpr double straightest = 0.999;

  template <class S>
  S cosine_of(const S& c) const {
    return (a_ * a_ + b_ * b_ - c * c) / (2.0 * a_ * b_);
  }
  template <class S>
  Stand<S> by_points(const S& rise_m) const {
    using std::acos;
    using std::sqrt;
    const S c = opened_m_ - rise_m, cosine = cosine_of(c);
    const S arm = a_ * b_ * sqrt(1.0 - cosine * cosine) / c;
    return {opening_rad_ - acos(cosine), arm, (arm * arm - a_ * b_ * cosine) / c};
  }
  template <class S>
  Stand<S> by_table(const S& rise_m) const {
    using std::sqrt;
    S angle = S(table_[0].angle_rad), arm_there = S(table_[0].arm_m), slope = S(slope_m(0)),
      from = S(risen_m_[0]);
    for (std::size_t i = 1; i < lines(); ++i) {
      const auto beyond = rise_m > risen_m_[i];
      angle = select(beyond, S(table_[i].angle_rad), angle);
      arm_there = select(beyond, S(table_[i].arm_m), arm_there);
      slope = select(beyond, S(slope_m(i)), slope);
      from = select(beyond, S(risen_m_[i]), from);
    }
    const S on_m = rise_m - from, arm = sqrt(arm_there * arm_there + 2.0 * slope * on_m);
    return {angle + 2.0 * on_m / (arm_there + arm), arm, slope};
  }
  P squared_arm_m2(const P& rise_m) const {
    P squared = P(0.0);
    for (std::size_t i = 0; i < lines(); ++i) {
      const P on_m = rise_m - risen_m_[i];
      const P here = table_[i].arm_m * table_[i].arm_m + 2.0 * slope_m(i) * on_m;
      squared = i == 0 ? here : select(on_m > 0.0, here, squared);
    }
    return squared;
  }
  /// Stretches between lines; beyond the first and the last the table goes on straight.
  std::size_t lines() const { return table_.size() == 1 ? 1 : table_.size() - 1; }
  P slope_m(std::size_t i) const {
    if (table_.size() == 1) return P(0.0);
    return (table_[i + 1].arm_m - table_[i].arm_m) / (table_[i + 1].angle_rad - table_[i].angle_rad);
  }

  P a_, b_, opening_rad_, opened_m_;
  std::vector<ArmAtOf<P>> table_;
  std::vector<P> risen_m_;  ///< x at its lines
};
using Turning = TurningOf<double>;

}  // namespace mckibben::plant
