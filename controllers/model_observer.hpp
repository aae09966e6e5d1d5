// What counts tell of what a model does not know: a load or a pressure that is wrong moves the rig the same
// way up and down, friction that is wrong the other way. Counts may be some ticks old: they are compared with
// what the model showed then, which accounts for a delay as Smith's predictor does (Smith, Chem. Eng. Prog.
// 53 (1957) 217-219).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <controllers/controller.hpp>
#include <controllers/delayed.hpp>

namespace mckibben::controllers {

/// What feedback by a model says of its counts.
struct ObserverTerms {
  int feedback_delay_ticks = 0;
  std::optional<double> filter_time_s = std::nullopt;

  static void fields(auto& self, auto& visit) {
    visit("feedback_delay_ticks", self.feedback_delay_ticks, 0, 1000, "age of the counts that are used");
    visit("filter_time", self.filter_time_s, "s", 1e-4, 100.0,
          "time constant with which the model's error is learned; 60 ms and the feedback delay if absent");
  }
};

/// All in contraction ratios. Once each tick: `look`, `learn` where counts are to be believed, then `unknown`
/// is what the model's target is to be moved by.
class ModelObserver {
 public:
  ModelObserver(const ObserverTerms& terms, const Knowledge& known);

  /// `shown`: by the model, where it begins.
  void begin(double shown) { turned_at_ = shown; }
  /// What the encoder of the model shows at this tick.
  void look(double shown);
  /// Counts of this tick, as old as they are used.
  void learn(std::int64_t counts);
  double unknown() const { return unknown(way_); }

  std::vector<Finding> findings() const;

 private:
  struct Shown {
    double ratio, way;
  };
  double unknown(double way) const { return bias_ + way * friction_; }
  void turn(double shown);

  double per_count_, middle_of_count_, gain_;
  Delayed<Shown> past_;
  Shown then_{};
  std::int64_t ticks_without_belief_ = 0;
  double bias_ = 0.0, friction_ = 0.0, way_ = 1.0, turned_at_ = 0.0;
};

}  // namespace mckibben::controllers
