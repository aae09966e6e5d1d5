// The plan, and what it expects of itself.
#include <algorithm>
#include <cmath>
#include <cstddef>
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

}  // namespace

std::unique_ptr<Controller> ModelInverseSettings::make(const Knowledge& knowledge) const {
  return std::make_unique<ModelInverse>(*this, name, 0, knowledge);
}

}  // namespace mckibben::controllers
