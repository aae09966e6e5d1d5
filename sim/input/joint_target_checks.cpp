// Angles against the muscles and the valves; see the header.
#include <fmt/format.h>

#include <plant/plant.hpp>
#include <sim/data/joint_reach.hpp>
#include <sim/input/joint_target_checks.hpp>
#include <sim/input/target_place.hpp>

namespace mckibben::input {

void check_joint_target(const YamlFile& file, const Node& node, const domain::JointTarget& target,
                        const domain::Scenario& scenario, Problems& problems) {
  const Node& angle = *node.find("angle");
  const plant::Rig& rig = scenario.rig;
  const plant::Pair& pair = *rig.pair();
  const auto [lowest, highest] = controllers::range(target.angle, scenario.duration_s, 1.0);
  const auto place_of = [&](double angle_rad) {
    return place_of_value(target.angle, angle, 1.0, [&](double value) {
      return angle_rad > 0.0 ? value >= angle_rad : value <= angle_rad;
    });
  };
  bool fits = true;
  const auto check = [&](int muscle, double mounted, double angle_rad, const plant::Muscle& of) {
    const double turned = (muscle == 1 ? angle_rad : -angle_rad) * rig.joint.wheel_radius_m,
                 most = mounted + turned / of.rest_length_m,
                 largest = plant::Braid(of).largest_contraction_ratio();
    if (most <= largest) return;
    fits = false;
    problems.error(file.source, place_of(angle_rad),
                   fmt::format("the angle takes muscle {} to a contraction ratio of {:.4g}; its limit is "
                               "{:.4g} (T 2.10)",
                               muscle, most, largest));
  };
  check(1, pair.contraction_ratio, highest, rig.muscle);
  check(2, pair.opposite_contraction_ratio, lowest, pair.opposite.muscle);
  if (!fits || problems.errors() > 0) return;
  for (const double load_kg : scenario.loads_kg) {
    const data::BeyondJoint beyond = data::beyond_joint(scenario, target, load_kg);
    if (!beyond.angle.empty()) problems.warning(file.source, place_of(beyond.angle_rad), beyond.angle);
    if (!beyond.stiffness.empty()) {
      const auto asked = [&](double value) { return value == beyond.stiffness_N_m_per_rad; };
      problems.warning(file.source, place_of_value(*target.stiffness, *node.find("stiffness"), 1.0, asked),
                       beyond.stiffness);
    }
    if (!beyond.angle.empty() || !beyond.stiffness.empty()) break;  // other loads ask alike
  }
}

}  // namespace mckibben::input
