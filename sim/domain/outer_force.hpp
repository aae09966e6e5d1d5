// A force that a scenario puts on the cord, or a torque on the joint: a load that changes in a run, a push, a
// disturbance.
#pragma once

namespace mckibben::domain {

/// From an instant until the next of its list.
struct From {
  double at_s = 0.0;

  static void fields(auto& self, auto& visit) {
    visit.required("at", self.at_s, "s", 0.0, 3600.0, "from the first tick not before it");
  }
};

inline constexpr double largest_outside = 1e5;  ///< N or N m

/// A force on the cord from outside.
struct OuterForce : From {
  double force_N = 0.0;

  static void fields(auto& self, auto& visit) {
    From::fields(self, visit);
    visit.required("force", self.force_N, "N", -largest_outside, largest_outside,
                   "positive lengthens the muscle, as a load does: 9.80665 N for a kilogram");
  }
};

/// The same of a joint with an angle.
struct OuterTorque : From {
  double torque_N_m = 0.0;

  static void fields(auto& self, auto& visit) {
    From::fields(self, visit);
    visit.required("torque", self.torque_N_m, "N.m", -largest_outside, largest_outside,
                   "positive where it turns as muscle 1 does that contracts");
  }
};

/// What acts so on the cord that runs on the joint's wheel.
inline double as_force_N(double torque_N_m, double wheel_radius_m) {
  return -torque_N_m / wheel_radius_m;
}

}  // namespace mckibben::domain
