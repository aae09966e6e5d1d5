// The thesis's inverse within the rig's limits (ours; T 5 suggests it): the target is first slowed to what is
// reachable, and the current leads it by the lag of valve and hose.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <controllers/calibrated.hpp>
#include <controllers/safety.hpp>

namespace mckibben::controllers {

struct OpenLoopLimitedSettings : CalibratedSettings, SafetyTerms {
  static constexpr std::string_view kind = "open_loop_limited";
  std::string name{kind};

  /// Throws std::invalid_argument if `knowledge.reach` is empty.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    CalibratedSettings::fields(self, visit);
    SafetyTerms::fields(self, visit);
  }
};

}  // namespace mckibben::controllers
