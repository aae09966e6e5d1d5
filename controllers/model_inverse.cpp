// See the header.
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <controllers/look_ahead.hpp>
#include <controllers/model_inverse.hpp>

namespace mckibben::controllers {
namespace {

class ModelInverse final : public ModelledController {
 public:
  using ModelledController::ModelledController;

  std::vector<Finding> findings() const override {
    std::vector<Finding> found = ModelledController::findings();
    found.push_back({"planned_rmse", "1", plan_.rmse});
    return found;
  }

 private:
  void begin(std::unique_ptr<RigModel> model, std::int64_t tick, double before_mA) override {
    begin_ = tick;
    plan_ = plan(*model, tick, before_mA);
  }

  double drive_mA(std::int64_t tick, std::int64_t) override {
    const auto last = static_cast<std::int64_t>(plan_.currents_mA.size()) - 1;
    return plan_.currents_mA[static_cast<std::size_t>(std::min(tick - begin_, last))];
  }

  std::int64_t begin_ = 0;
  Plan plan_;
};

/// One tick: what the counts say of the model, then the current that brings the model to the moved target.
class ModelInverseFeedback final : public ModelledController {
 public:
  ModelInverseFeedback(const ModelInverseFeedbackSettings& settings, const Knowledge& known)
      : ModelledController(settings, settings.name, settings.feedback_delay_ticks, known),
        look_(range().width_mA(), look_ahead_ticks()),
        observer_(settings, known) {}

  std::vector<Finding> findings() const override {
    std::vector<Finding> found = ModelledController::findings();
    for (Finding& one : observer_.findings()) found.push_back(std::move(one));
    return found;
  }

 private:
  void begin(std::unique_ptr<RigModel> model, std::int64_t tick, double before_mA) override {
    plan(*model, tick, before_mA);  // of use only if it says that it cannot be followed
    model_ = std::move(model);
    before_mA_ = before_mA;
    observer_.begin(model_->shown_ratio());
  }

  double drive_mA(std::int64_t tick, std::int64_t counts) override {
    observer_.look(model_->shown_ratio());
    if (!counts_are_lost()) observer_.learn(counts);
    const double target = aim(tick, look_ahead_ticks()) - observer_.unknown();
    before_mA_ = model_->given_mA(look_.current_mA(*model_, target, before_mA_, range_after(before_mA_)));
    model_->step({before_mA_}, 1);
    return before_mA_;
  }

  LookAhead look_;
  ModelObserver observer_;
  std::unique_ptr<RigModel> model_;
  double before_mA_ = 0.0;
};

}  // namespace

std::unique_ptr<Controller> ModelInverseSettings::make(const Knowledge& knowledge) const {
  return std::make_unique<ModelInverse>(*this, name, 0, knowledge);
}

std::unique_ptr<Controller> ModelInverseFeedbackSettings::make(const Knowledge& knowledge) const {
  return std::make_unique<ModelInverseFeedback>(*this, knowledge);
}

}  // namespace mckibben::controllers
