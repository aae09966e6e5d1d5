// Least squares in one dimension; see the header.
#include <algorithm>
#include <cmath>

#include <sim/run/remembered.hpp>

namespace mckibben::run {
namespace {

constexpr double most = 0.5, step = 0.01, near = 1e-3;  // in working sizes of memories
constexpr int most_steps = 4;

/// How much further the memories should be, by the line from one recording to another that is `step` on.
double further(const Recording& here, const Recording& aside, double length_m, const Seen& seen) {
  double along = 0.0, square = 0.0;
  for (std::size_t k = 0; k < std::min(here.samples.size(), seen.contraction_ratio.size()); ++k) {
    const auto ratio = [&](const Recording& recording) {
      return recording.samples[k].state.joint.contraction_ratio * length_m / seen.rest_length_m;
    };
    if (std::isnan(seen.contraction_ratio[k]) || here.samples[k].time_s < seen.from_s) continue;
    const double slope = (ratio(aside) - ratio(here)) / step;
    along += slope * (seen.contraction_ratio[k] - ratio(here));
    square += slope * slope;
  }
  return square > 0.0 ? along / square : 0.0;
}

}  // namespace

Recording follow_as_seen(const plant::Rig& rig, double load_kg, Course course, const Seen& seen) {
  Recording here = follow(rig, load_kg, course);
  if (!course.begins || !rig.remembers()) return here;
  double& memories = course.begins->memories;
  for (int count = 0; count < most_steps && here.failure.empty(); ++count) {
    const double at = memories;
    memories = at + step;
    const Recording aside = follow(rig, load_kg, course);
    if (!aside.failure.empty()) break;
    const double way = further(here, aside, rig.muscle.rest_length_m, seen);
    memories = std::clamp(at + way, -most, most);
    if (std::abs(memories - at) < near) break;
    here = follow(rig, load_kg, course);
  }
  return here;
}

}  // namespace mckibben::run
