// What is asked of every controller of a joint whose angle is read: a pair's or a lever's.
#pragma once

#include <numbers>
#include <optional>

#include <controllers/command_filter.hpp>
#include <controllers/controller.hpp>

namespace mckibben::controllers {

/// Contraction ratio for each radian of the joint, as its wheel measures it. Throws std::invalid_argument for
/// a hanging load.
double ratio_per_rad(const Knowledge& known);

/// No limits unless given.
struct AngleTerms : CommandTerms {
  std::optional<double> lowest_angle_rad = std::nullopt, highest_angle_rad = std::nullopt;
  std::optional<double> fastest_joint_rad_per_s = std::nullopt;

  /// With targets cut at the angles that are allowed.
  Knowledge within_angles(Knowledge known) const;
  /// `fastest_joint` as contraction ratio.
  std::optional<double> fastest_load_per_s(const Knowledge& known) const;

  static void fields(auto& self, auto& visit) {
    constexpr double turn_rad = 2.0 * std::numbers::pi;
    CommandTerms::fields(self, visit);
    visit("lowest_angle", self.lowest_angle_rad, "rad", -turn_rad, turn_rad,
          "joint angle at which a lower target is cut");
    visit("highest_angle", self.highest_angle_rad, "rad", -turn_rad, turn_rad,
          "joint angle at which a higher target is cut");
    visit("fastest_joint", self.fastest_joint_rad_per_s, "rad/s", 1e-2, 1e4,
          "speed that the joint never has: counts that jump further from tick to tick are rejected");
  }
  void rules(auto& report) const {
    if (lowest_angle_rad && highest_angle_rad && *highest_angle_rad <= *lowest_angle_rad)
      report("highest_angle", "must be above lowest_angle");
  }
};

}  // namespace mckibben::controllers
