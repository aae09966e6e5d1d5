// How far the valves of two muscles turn their joint at rest, and how stiff they make it there: what a target
// asks beyond that no controller can give.
#pragma once

#include <optional>
#include <string>

#include <plant/plant.hpp>
#include <sim/domain/scenario.hpp>

namespace mckibben::data {

class JointReach {
 public:
  struct Ends {
    double lowest = 0.0, highest = 0.0;
  };

  /// Of a pair, what it holds among its mechanics. Cords are taken for taut, effects as they are at rest.
  explicit JointReach(const plant::Rig& rig);

  /// Angles [rad] to which it turns, without friction.
  Ends angle_rad() const;
  /// Stiffness [N m/rad] with which it stays at an angle, with friction's help; none where it does not.
  std::optional<Ends> stiffness_N_m_per_rad(double angle_rad) const;

 private:
  struct At {
    double angle_rad;
    double one_Pa, two_Pa;
  };
  plant::State<double> state_at(const At& at) const;
  /// What pulls up beside friction, and as much as friction holds.
  struct Pull {
    double net_N, friction_N;
  };
  Pull pull(const At& at) const;

  plant::Plant plant_;
  Ends one_Pa_, two_Pa_, ends_rad_;
};

/// What a target of a pair asks beyond its joint's reach: the farthest, in words; empty where it asks nothing
/// such.
struct BeyondJoint {
  std::string angle, stiffness;
  double angle_rad = 0.0, stiffness_N_m_per_rad = 0.0;  ///< asked
};
BeyondJoint beyond_joint(const domain::Scenario& scenario, const domain::JointTarget& target, double load_kg);

}  // namespace mckibben::data
