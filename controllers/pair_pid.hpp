// PID control of the angle of a joint that two muscles turn: the difference of their pressures follows the
// error, while P0 is held or follows the wanted stiffness (P0 +- dP; T 2.7). The PID is that of one muscle.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <controllers/co_contraction.hpp>
#include <controllers/pid.hpp>

namespace mckibben::controllers {

struct PairPidSettings : PidForm, JointTerms {
  static constexpr std::string_view kind = "pid";
  std::string name{kind};

  /// Throws std::invalid_argument if a gain is missing, or the rig has one muscle.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    visit("proportional", self.proportional_mA, "mA/rad", 0.0, 1e6,
          "gain K, by which the command to muscle 1 rises for an error of the angle; tuned if absent");
    PidForm::fields(self, visit);
    visit("tuning_load", self.tuning_load_kg, "kg", 0.0, 500.0,
          "load in the hand at which missing gains are tuned; the scenario's median load if absent");
    JointTerms::fields(self, visit);
  }
  void rules(auto& report) const { JointTerms::rules(report); }
};

}  // namespace mckibben::controllers
