// Two unknowns, one filter; see the header.
#include <algorithm>
#include <cmath>

#include <controllers/model_observer.hpp>

namespace mckibben::controllers {
namespace {

constexpr double usual_filter_s = 0.06;
constexpr double counts_to_turn = 3.0;  // by which the model goes back before the way counts as the other
constexpr double largest_news = 0.05;   // contraction ratio; more is not what a model lacks
constexpr double share_of_way = 0.5;    // of what is new: believed to change its sign with the way

}  // namespace

ModelObserver::ModelObserver(const ObserverTerms& terms, const Knowledge& known)
    : per_count_(known.contraction_per_count),
      middle_of_count_(known.middle_of_count),
      gain_(-std::expm1(-known.tick_s / terms.filter_time_s.value_or(
                                            usual_filter_s + terms.feedback_delay_ticks * known.tick_s))),
      past_(terms.feedback_delay_ticks) {}

void ModelObserver::look(double shown) {
  turn(shown);
  then_ = past_({shown, way_});
}

/// Which way the model last moved by some counts: up 1, down -1.
void ModelObserver::turn(double shown) {
  if (way_ * (shown - turned_at_) > 0.0) turned_at_ = shown;
  if (way_ * (shown - turned_at_) < -counts_to_turn * per_count_) {
    way_ = -way_;
    turned_at_ = shown;
  }
}

/// Within half a count they tell nothing. What is new is shared by both unknowns, and sorts itself when the
/// load turns.
void ModelObserver::learn(std::int64_t counts) {
  const double dead = 0.5 * per_count_;
  const double e = (static_cast<double>(counts) + middle_of_count_) * per_count_;
  const double news = e - then_.ratio - unknown(then_.way);
  if (std::abs(news) > largest_news) {  // the counter stands still, or something holds the load
    ++ticks_without_belief_;
    return;
  }
  const double beyond = news - std::clamp(news, -dead, dead);
  bias_ += (1.0 - share_of_way) * gain_ * beyond;
  friction_ += share_of_way * gain_ * then_.way * beyond;
}

std::vector<Finding> ModelObserver::findings() const {
  std::vector<Finding> found{{"unknown_either_way", "1", bias_}, {"unknown_by_way", "1", friction_}};
  if (ticks_without_belief_ > 0)
    found.push_back({"ticks_counts_contradict", "1", static_cast<double>(ticks_without_belief_)});
  return found;
}

}  // namespace mckibben::controllers
