// See the header.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <controllers/look_ahead.hpp>
#include <controllers/model_inverse.hpp>

namespace mckibben::controllers {
namespace {

/// The plan, and what it expects of itself.
class ModelInverse final : public ModelledController {
 public:
  using ModelledController::ModelledController;

  std::vector<Finding> findings() const override {
    std::vector<Finding> found = ModelledController::findings();
    found.push_back({"planned_rmse", "1", planned_rmse_});
    return found;
  }

 private:
  void begin(std::unique_ptr<RigModel> model, std::int64_t tick, double before_mA) override {
    LookAhead look(range().width_mA(), terms().look_ahead_ticks);
    const auto end = static_cast<std::int64_t>(knowledge().target.size());
    double squares = 0.0;
    for (std::int64_t k = begin_ = tick; k < end; ++k) {
      before_mA = model->given_mA(look.current_mA(*model, aim(k), before_mA, range_after(before_mA)));
      if (k >= 0) squares += std::pow(model->contraction_ratio() - knowledge().target_at(k), 2);
      model->step({before_mA});
      plan_mA_.push_back(before_mA);
    }
    planned_rmse_ = std::sqrt(squares / static_cast<double>(std::max<std::int64_t>(end, 1)));
  }

  double drive_mA(std::int64_t tick, std::int64_t) override {
    const auto last = static_cast<std::int64_t>(plan_mA_.size()) - 1;
    return plan_mA_[static_cast<std::size_t>(std::min(tick - begin_, last))];
  }

  std::int64_t begin_ = 0;
  std::vector<double> plan_mA_;
  double planned_rmse_ = 0.0;
};

/// One tick: what the counts say of the model, then the current that brings the model to the moved target.
class ModelInverseFeedback final : public ModelledController {
 public:
  ModelInverseFeedback(const ModelInverseFeedbackSettings& settings, const Knowledge& known)
      : ModelledController(settings, settings.name, settings.feedback_delay_ticks, known),
        look_(range().width_mA(), settings.look_ahead_ticks),
        observer_(settings, known) {}

  std::vector<Finding> findings() const override {
    std::vector<Finding> found = ModelledController::findings();
    for (Finding& one : observer_.findings()) found.push_back(std::move(one));
    return found;
  }

 private:
  void begin(std::unique_ptr<RigModel> model, std::int64_t, double before_mA) override {
    model_ = std::move(model);
    before_mA_ = before_mA;
    observer_.begin(model_->shown_ratio());
  }

  double drive_mA(std::int64_t tick, std::int64_t counts) override {
    observer_.look(model_->shown_ratio());
    if (!counts_are_lost()) observer_.learn(counts);
    const double target = aim(tick) - observer_.unknown();
    before_mA_ = model_->given_mA(look_.current_mA(*model_, target, before_mA_, range_after(before_mA_)));
    model_->step({before_mA_});
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
