// One tick: what the counts say of the model, then the current that brings the model to the moved target.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <controllers/look_ahead.hpp>
#include <controllers/model_inverse_feedback.hpp>

namespace mckibben::controllers {
namespace {

constexpr double counts_to_turn = 3.0;  // by which the model goes back before the way counts as the other
constexpr double largest_news = 0.05;   // contraction ratio; more is not what a model lacks
constexpr double share_of_way = 0.5;    // of what is new: believed to change its sign with the way

class ModelInverseFeedback final : public ModelledController {
 public:
  ModelInverseFeedback(const ModelInverseFeedbackSettings& settings, const Knowledge& known)
      : ModelledController(settings, settings.name, settings.feedback_delay_ticks, known),
        look_(range().width_mA(), settings.look_ahead_ticks),
        gain_(-std::expm1(-1.0 / settings.filter_ticks.value_or(5.0 + settings.feedback_delay_ticks))),
        then_(settings.feedback_delay_ticks) {}

  std::vector<Finding> findings() const override {
    std::vector<Finding> found = ModelledController::findings();
    found.push_back({"unknown_either_way", "1", bias_});
    found.push_back({"unknown_by_way", "1", friction_});
    if (ticks_without_belief_ > 0)
      found.push_back({"ticks_counts_contradict", "1", static_cast<double>(ticks_without_belief_)});
    return found;
  }

 private:
  struct Shown {
    double ratio, way;
  };

  void begin(std::unique_ptr<RigModel> model, std::int64_t, double before_mA) override {
    model_ = std::move(model);
    before_mA_ = before_mA;
    turned_at_ = model_->shown_ratio();
  }

  double drive_mA(std::int64_t tick, std::int64_t counts) override {
    turn();
    const Shown then = then_({model_->shown_ratio(), way_});
    if (!counts_are_lost()) learn(counts, then);
    const double target = aim(tick) - unknown(way_);
    before_mA_ = model_->given_mA(look_.current_mA(*model_, target, before_mA_, range_after(before_mA_)));
    model_->step(before_mA_);
    return before_mA_;
  }

  double unknown(double way) const { return bias_ + way * friction_; }

  /// Which way the model last moved by some counts: up 1, down -1.
  void turn() {
    const double e = model_->shown_ratio(), some = counts_to_turn * knowledge().contraction_per_count;
    if (way_ * (e - turned_at_) > 0.0) turned_at_ = e;
    if (way_ * (e - turned_at_) < -some) {
      way_ = -way_;
      turned_at_ = e;
    }
  }

  /// What the counts, and the model's ratio then, tell of what the model does not know. Within half a count
  /// they tell nothing. A load or a pressure that is wrong moves the rig the same way up and down, friction
  /// that is wrong the other way: what is new is shared by both, and sorts itself when the load turns.
  void learn(std::int64_t counts, const Shown& then) {
    const double q = knowledge().contraction_per_count, dead = 0.5 * q;
    const double e = (static_cast<double>(counts) + knowledge().middle_of_count) * q;
    const double news = e - then.ratio - unknown(then.way);
    if (std::abs(news) > largest_news) {  // the counter stands still, or something holds the load
      ++ticks_without_belief_;
      return;
    }
    const double beyond = news - std::clamp(news, -dead, dead);
    bias_ += (1.0 - share_of_way) * gain_ * beyond;
    friction_ += share_of_way * gain_ * then.way * beyond;
  }

  LookAhead look_;
  double gain_;
  Delayed<Shown> then_;
  std::unique_ptr<RigModel> model_;
  std::int64_t ticks_without_belief_ = 0;
  double before_mA_ = 0.0, bias_ = 0.0, friction_ = 0.0, way_ = 1.0, turned_at_ = 0.0;
};

}  // namespace

std::unique_ptr<Controller> ModelInverseFeedbackSettings::make(const Knowledge& knowledge) const {
  return std::make_unique<ModelInverseFeedback>(*this, knowledge);
}

}  // namespace mckibben::controllers
