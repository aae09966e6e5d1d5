// The thesis's controller (T 4.3): load weighed, then current from the inverse, no feedback. As the thesis
// has it, a triangle of constant current speed to one contraction at one speed;
// or along a target, tick by tick.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <controllers/calibrated.hpp>
#include <controllers/safety.hpp>
#include <controllers/target.hpp>

namespace mckibben::controllers {

enum class OpenLoopMode { trajectory, triangle };
constexpr auto names(OpenLoopMode) {
  using enum OpenLoopMode;
  return std::array{std::pair{trajectory, std::string_view{"trajectory"}},
                    std::pair{triangle, std::string_view{"triangle"}}};
}

struct OpenLoopSettings : CalibratedSettings, SafetyTerms {
  static constexpr std::string_view kind = "open_loop";
  std::string name{kind};
  OpenLoopMode mode = OpenLoopMode::trajectory;
  Height to;
  double speed_per_s = 0.0;

  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    CalibratedSettings::fields(self, visit);
    visit("mode", self.mode, "along the scenario's target (trajectory), or to one point (triangle)");
    visit("to", self.to, "triangle: height to pass, as contraction ratio or length");
    visit("speed", self.speed_per_s, "1/s", -100.0, 100.0,
          "triangle: contraction speed to pass it at; negative on the way down");
    SafetyTerms::fields(self, visit);
  }
  void rules(auto& report) const {
    CalibratedSettings::rules(report);
    check_height(report, "to", to);
    const bool given = to.value > 0.0 && speed_per_s != 0.0;
    if (mode == OpenLoopMode::triangle && !given) report("mode", "a triangle needs `to` and `speed`");
    if (mode == OpenLoopMode::trajectory && (to.value != 0.0 || speed_per_s != 0.0))
      report("mode", "`to` and `speed` are for mode: triangle; a trajectory follows the target");
  }
};

}  // namespace mckibben::controllers
