// Open-loop control by a model of the whole rig (ours): the load is weighed, then the currents of the whole
// run are planned on the model, and no count is looked at again. The thesis names the limits of its fitted
// inverse, and leaves them open (T 5).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <controllers/modelled.hpp>

namespace mckibben::controllers {

struct ModelInverseSettings : ModelTerms {
  static constexpr std::string_view kind = "model_inverse";
  std::string name{kind};

  /// Throws std::invalid_argument if there is no model.
  std::unique_ptr<Controller> make(const Knowledge& knowledge) const;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit("name", self.name, "name in tables and file names");
    ModelTerms::fields(self, visit);
  }
};

}  // namespace mckibben::controllers
