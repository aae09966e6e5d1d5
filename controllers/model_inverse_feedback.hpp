// The model's inverse with feedback (ours): internal model control (Garcia & Morari, Ind. Eng. Chem. Process
// Des. Dev. 21 (1982) 308-323). The model runs beside the rig under the same currents; what counts that are
// some ticks old show beyond what the model showed then is what the model does not know, and the target is
// moved by it. A delay is so accounted for as in Smith's predictor (Smith, Chem. Eng. Prog. 53 (1957)
// 217-219).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <controllers/model_observer.hpp>
#include <controllers/modelled.hpp>

namespace mckibben::controllers {

struct ModelInverseFeedbackSettings : ModelTerms, ObserverTerms {
  static constexpr std::string_view kind = "model_inverse_feedback";
  std::string name{kind};

  /// Throws std::invalid_argument if there is no model.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("name", self.name, "name in tables and file names");
    ModelTerms::fields(self, visit);
    ObserverTerms::fields(self, visit);
  }
};

}  // namespace mckibben::controllers
