// Control of a pair by a model of the whole rig (ours): both currents are found on the model so that the
// joint has the wanted angle and, where one is asked for, the wanted stiffness. `model_inverse` plans the
// whole run and looks at no count; `model_inverse_feedback` looks at each, and moves the target by what the
// model does not know (ModelObserver): the load in the hand, above all.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <controllers/co_contraction.hpp>
#include <controllers/model_observer.hpp>
#include <controllers/rig_model.hpp>

namespace mckibben::controllers {

struct PairModelTerms : PlansWithModel, JointTerms {
  double assumed_load_kg = 0.0;

  static void fields(auto& self, auto& visit) {
    PlansWithModel::fields(self, visit);
    visit("assumed_load", self.assumed_load_kg, "kg", 0.0, 500.0, "load in the hand of its model");
    JointTerms::fields(self, visit);
  }
};

struct PairModelInverseSettings : PairModelTerms {
  static constexpr std::string_view kind = "model_inverse";
  std::string name{kind};

  /// Throws std::invalid_argument if there is no model, or the rig has one muscle.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    PairModelTerms::fields(self, visit);
  }
};

struct PairModelInverseFeedbackSettings : PairModelTerms, ObserverTerms {
  static constexpr std::string_view kind = "model_inverse_feedback";
  std::string name{kind};

  /// Throws std::invalid_argument if there is no model, or the rig has one muscle.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  static void fields(auto& self, auto& visit) {
    visit("name", self.name, "name in tables and file names");
    PairModelTerms::fields(self, visit);
    ObserverTerms::fields(self, visit);
  }
};

}  // namespace mckibben::controllers
