// Open-loop control by the nominal static law turned round (T 2.8; Tondu & Lopez 2000): the pressure at which
// the braid holds an assumed load at the target, and the current that the valve's line gives for it.
// It knows no friction, no gas and no feedback, so it is the yardstick that better controllers are held to.
#pragma once

#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include <controllers/safety.hpp>

namespace mckibben::controllers {

/// P = m g / (pi r0^2 [a (1 - k e)^2 - b]), a = 3/tan^2 alpha0, b = 1/sin^2 alpha0.
struct StaticInverseSettings : SafetyTerms {
  static constexpr std::string_view kind = "static_inverse";
  std::string name{kind};
  double assumed_load_kg = 0.0;
  std::optional<double> rest_radius_m = std::nullopt;
  std::optional<double> braid_angle_rad = std::nullopt;
  std::optional<double> end_correction = std::nullopt;

  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    constexpr double degree_rad = std::numbers::pi / 180.0;
    visit("name", self.name, "name in tables and file names");
    visit.required("assumed_load", self.assumed_load_kg, "kg", 0.0, 500.0, "load of its model, m");
    visit("rest_radius", self.rest_radius_m, "m", 5e-4, 0.2, "radius of its model, r0; the rig's if absent");
    visit("braid_angle", self.braid_angle_rad, "rad", 5.0 * degree_rad, 50.0 * degree_rad,
          "braid angle of its model, alpha0; the rig's if absent");
    visit("end_correction", self.end_correction, "1", 1.0, 2.5,
          "end correction of its model, k; the rig's if absent");
    SafetyTerms::fields(self, visit);
  }
};

}  // namespace mckibben::controllers
