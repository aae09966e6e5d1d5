// PID with the thesis's inverse as feedforward (ours): the inverse knows the muscle, the PID makes up for
// what the inverse does not know, and tells it the load.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <controllers/calibrated.hpp>
#include <controllers/pid.hpp>

namespace mckibben::controllers {

struct FeedforwardPidSettings : CalibrationTerms, PidTerms {
  static constexpr std::string_view kind = "feedforward_pid";
  std::string name{kind};

  /// Throws std::invalid_argument if a gain is missing, or what is reachable was not computed.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    CalibrationTerms::fields(self, visit);
    PidTerms::fields(self, visit);
  }
  void rules(auto& report) const {
    CalibrationTerms::rules(report);
    PidTerms::rules(report);
  }
};

}  // namespace mckibben::controllers
