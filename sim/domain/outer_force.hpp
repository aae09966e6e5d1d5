// A force that a scenario puts on the cord: a load that changes in a run, a push, a disturbance.
#pragma once

namespace mckibben::domain {

/// A force on the cord from outside, from an instant until the next of its list.
struct OuterForce {
  double at_s = 0.0, force_N = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.required("at", self.at_s, "s", 0.0, 3600.0, "from the first tick not before it");
    visit.required("force", self.force_N, "N", -1e5, 1e5,
                   "positive lengthens the muscle, as a load does: 9.80665 N for a kilogram");
  }
};

}  // namespace mckibben::domain
