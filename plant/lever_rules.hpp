// What must be true between a muscle, the lever that it turns and the ends of its way. Part of rig.hpp, which
// includes it.
#pragma once

#include <cmath>

#include <plant/rig.hpp>

namespace mckibben::plant {

/// What pulls at a muscle at rest length, as a load [kg].
inline double pulled_by_lever_kg(const Rig& rig, double load_kg) {
  const Lever& lever = *rig.lever();
  const Stand<double> there = Turning(lever).at(-lever.contraction_ratio * rig.muscle.rest_length_m);
  double moment_kg_m = lever.spring().pull(there.angle_rad) / gravity_m_per_s2;
  if (lever.plane == Plane::vertical)
    moment_kg_m += (lever.mass_kg * lever.centre_m + (load_kg + rig.joint.load_offset_kg) * lever.load_at_m) *
                   std::sin(there.angle_rad - lever.hangs_at_rad);
  return moment_kg_m / there.arm_m;
}

/// How far the cord rises and falls from where the muscle is mounted: to its rest length and its largest
/// contraction, but for the joint's stops.
struct Way {
  double low_m, high_m;
};
inline Way way_of(const Rig& rig, const Turning& turning) {
  const Lever& lever = *rig.lever();
  const Joint& joint = rig.joint;
  const auto rise_m = [&](double ratio) {
    return (ratio - lever.contraction_ratio) * rig.muscle.rest_length_m;
  };
  Way way{rise_m(0.0), rise_m(Braid(rig.muscle).largest_contraction_ratio())};
  if (joint.lowest_rad > joint.nowhere_rad[0])
    way.low_m = std::max(way.low_m, turning.rise_m(joint.lowest_rad));
  if (joint.highest_rad < joint.nowhere_rad[1])
    way.high_m = std::min(way.high_m, turning.rise_m(joint.highest_rad));
  return way;
}

void lever_rules(const Rig& rig, auto& report) {
  const Lever& lever = *rig.lever();
  const Turning turning(lever);
  const double most = Braid(rig.muscle).largest_contraction_ratio();
  if (lever.contraction_ratio >= most)
    report("mechanics", "contraction is more than the muscle can contract (T 2.10)");
  if (rig.joint.has_spring())
    report("joint",
           "spring and spring_preload act on a cord: of a lever say those of mechanics, about its pivot");
  if (!rig.effects.get<GuideFriction>().absent())
    report("mechanics", "effects.guide_friction is of a hanging load's guide, which a lever has not");
  const SensorKind kind = rig.sensors.position().kind;
  if (kind != SensorKind::encoder && kind != SensorKind::potentiometer)
    report("sensors", "of a lever the angle is read, by an encoder or a potentiometer");
  if (lever.by_points() &&
      turning.distance_m(0.0) < (1.0 - lever.contraction_ratio) * rig.muscle.rest_length_m)
    return report("mechanics",
                  "the cord cannot be taut: at joint angle 0 the attachment points are nearer to each other "
                  "than the muscle is long; take larger distances or a larger opening");
  const auto [low_m, high_m] = way_of(rig, turning);
  if (!turning.in_domain(high_m))
    return report("mechanics",
                  "the cord's arm vanishes before the muscle is at its largest contraction: set "
                  "joint.highest_angle, or move the attachment points");
  if (!turning.in_domain(low_m))
    return report(
        "mechanics",
        "the cord's arm vanishes before the muscle is at its rest length: set joint.lowest_angle, or "
        "move the attachment points");
  if (lever.arms.size() < 2) return;
  constexpr double rounding_m = 1e-9;
  if (turning.rise_m(lever.arms.back().angle_rad) < high_m - rounding_m)
    report("mechanics",
           "arms ends before the muscle is at its largest contraction: go on with the table, or set "
           "joint.highest_angle");
  if (turning.rise_m(lever.arms.front().angle_rad) > low_m + rounding_m)
    report("mechanics",
           "arms begins after the muscle's rest length: begin the table below, or set joint.lowest_angle");
}

}  // namespace mckibben::plant
