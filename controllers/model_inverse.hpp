// Control by a model of the whole rig (ours): the load is weighed, then the currents are found on the model.
// `model_inverse` plans the whole run and looks at no count again: the thesis names the limits of its fitted
// inverse, and leaves them open (T 5). `model_inverse_feedback` is internal model control (Garcia & Morari,
// Ind. Eng. Chem. Process Des. Dev. 21 (1982) 308-323): the model runs beside the rig under the same
// currents; what counts that are some ticks old show beyond what the model showed then is what the model does
// not know, and the target is moved by it (ModelObserver).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <controllers/model_observer.hpp>
#include <controllers/modelled.hpp>

namespace mckibben::controllers {

struct ModelInverseSettings : ModelTerms {
  static constexpr std::string_view kind = "model_inverse";
  std::string name{kind};

  /// Throws std::invalid_argument if there is no model.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    ModelTerms::fields(self, visit);
  }
};

struct ModelInverseFeedbackSettings : ModelTerms, ObserverTerms {
  static constexpr std::string_view kind = "model_inverse_feedback";
  std::string name{kind};

  /// Throws std::invalid_argument if there is no model.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    ModelTerms::fields(self, visit);
    ObserverTerms::fields(self, visit);
  }
};

}  // namespace mckibben::controllers
