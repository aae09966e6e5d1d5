// PID control of the angle of a lever that one muscle turns. The PID is that of a load, in radians.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <controllers/angle_terms.hpp>
#include <controllers/pid.hpp>

namespace mckibben::controllers {

struct LeverPidSettings : PidForm, OutputLimits, AngleTerms, RestTerms {
  static constexpr std::string_view kind = "pid";
  std::string name{kind};
  std::optional<double> dead_zone_rad = std::nullopt;

  void follow(const CurrentRange& range);
  /// Throws std::invalid_argument if a gain is missing, or the rig has no angle.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    visit("proportional", self.proportional_mA, "mA/rad", 0.0, 1e6,
          "gain K, command for an error of a radian; tuned if absent");
    PidForm::fields(self, visit);
    visit("dead_zone", self.dead_zone_rad, "rad", 0.0, 3.0,
          "errors, either way, that count as none: solenoid valves rest there; none if absent");
    OutputLimits::fields(self, visit);
    visit("tuning_load", self.tuning_load_kg, "kg", 0.0, 500.0,
          "load at which missing gains are tuned; the scenario's median load if absent");
    AngleTerms::fields(self, visit);
    RestTerms::fields(self, visit);
  }
  void rules(auto& report) const {
    OutputLimits::rules(report);
    AngleTerms::rules(report);
    RestTerms::rules(report, *this);
  }
};

}  // namespace mckibben::controllers
