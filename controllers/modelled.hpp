// What controllers share that plan with a model of the whole rig: they weigh the load on it, unless they are
// told it, and then have a model that stands where the rig stands.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <controllers/controller.hpp>
#include <controllers/current_range.hpp>
#include <controllers/delayed.hpp>
#include <controllers/rig_model.hpp>
#include <controllers/rise_weighing.hpp>
#include <controllers/safety.hpp>

namespace mckibben::controllers {

struct ModelTerms : PlansWithModel, SafetyTerms {
  std::optional<double> assumed_load_kg = std::nullopt;
  std::optional<double> weighing_speed_mA_per_s = std::nullopt;

  void follow(const CurrentRange& range) {
    if (!weighing_speed_mA_per_s) weighing_speed_mA_per_s = range.width_mA() / 32.0;
  }

  static void fields(auto& self, auto& visit) {
    PlansWithModel::fields(self, visit);
    visit("assumed_load", self.assumed_load_kg, "kg", 0.01, 500.0,
          "load of its model; weighed before the run if absent");
    visit("weighing_speed", self.weighing_speed_mA_per_s, "mA/s", 1e-3, 1e5,
          "speed of the command while it weighs; 1/32 of the valve's span in a second if absent");
    SafetyTerms::fields(self, visit);
  }
};

/// Weighing; what is done with the model afterwards is the derived controller's.
class ModelledController : public Controller {
 public:
  /// `delay_ticks`: age of the counts. Throws std::invalid_argument if there is no model.
  ModelledController(const ModelTerms& terms, const std::string& name, int delay_ticks,
                     const Knowledge& knowledge);

  /// Begins at once where the load is told: whatever takes long is over before time counts.
  Command rest() final;
  std::int64_t preparation_ticks() const final;
  Command step(const Reading& reading) final;
  std::vector<Finding> findings() const override;

 protected:
  struct Plan {
    std::vector<double> currents_mA;
    double rmse = 0.0;  ///< on the model that it was made with
  };

  /// The load is known. `model` is at `tick`, as the rig is; `before_mA` was given in the tick before.
  virtual void begin(std::unique_ptr<RigModel> model, std::int64_t tick, double before_mA) = 0;
  /// Current at the tick of `begin` and after, as the DAC gives it; `counts` are as old as they are used.
  virtual double drive_mA(std::int64_t tick, std::int64_t counts) = 0;

  /// Currents from `tick` to the end of the target, on a copy of the model. Throws ControllerFailure where
  /// look_ahead is too short for it.
  Plan plan(const RigModel& model, std::int64_t tick, double before_mA) const;

  const Knowledge& knowledge() const { return knowledge_; }
  const CurrentRange& range() const { return range_; }
  /// Where the load is to be when a current of `tick` has done its work.
  double aim(std::int64_t tick, int ahead_ticks) const {
    return terms_.allowed(knowledge_.target_at(tick + ahead_ticks));
  }
  int look_ahead_ticks() const { return terms_.look_ahead_ticks(knowledge_.tick_s); }
  /// Currents that may follow on that of the tick before.
  CurrentRange range_after(double before_mA) const {
    return terms_.within_reach(range_, before_mA, knowledge_.tick_s);
  }
  /// Whether the counts of this tick are not to be believed.
  bool counts_are_lost() const { return believed_.lost(); }
  const ModelTerms& terms() const { return terms_; }

 private:
  Plan plan_on(RigModel& model, std::int64_t tick, double before_mA, int ahead_ticks) const;
  void begin_at(std::int64_t tick);
  double weigh_or_drive_mA(std::int64_t tick, std::int64_t counts);

  ModelTerms terms_;
  Knowledge knowledge_;
  CurrentRange range_;
  std::int64_t approach_ticks_;
  BelievedCounts believed_;
  Delayed<std::int64_t> delayed_;
  std::optional<RiseWeighing> weighing_;
  bool begun_ = false;
  std::exception_ptr could_not_begin_;
};

}  // namespace mckibben::controllers
