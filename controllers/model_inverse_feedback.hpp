// The model's inverse with feedback (ours): internal model control (Garcia & Morari, Ind. Eng. Chem. Process
// Des. Dev. 21 (1982) 308-323). The model runs beside the rig under the same currents; what counts that are
// some ticks old show beyond what the model showed then is what the model does not know, and the target is
// moved by it. A delay is so accounted for as in Smith's predictor (Smith, Chem. Eng. Prog. 53 (1957)
// 217-219).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <controllers/modelled.hpp>

namespace mckibben::controllers {

struct ModelInverseFeedbackSettings : ModelTerms {
  static constexpr std::string_view kind = "model_inverse_feedback";
  std::string name{kind};
  int feedback_delay_ticks = 0;
  std::optional<double> filter_ticks = std::nullopt;

  /// Throws std::invalid_argument if there is no model.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("name", self.name, "name in tables and file names");
    ModelTerms::fields(self, visit);
    visit("feedback_delay_ticks", self.feedback_delay_ticks, 0, 1000, "age of the counts that are used");
    visit("filter_ticks", self.filter_ticks, "1", 0.01, 1000.0,
          "ticks in which 1 - 1/e of what the model does not know is believed; 5 and the delay's if absent");
  }
};

}  // namespace mckibben::controllers
