// A tick on the model: the difference that brings its angle to the target a few ticks ahead, found as for one
// muscle (LookAhead), with the P0 that nominal muscles take for the wanted stiffness and what the model has
// shown to be missing.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <controllers/delayed.hpp>
#include <controllers/look_ahead.hpp>
#include <controllers/pair_model_inverse.hpp>
#include <controllers/safety.hpp>

namespace mckibben::controllers {
namespace {

constexpr double share_per_s =
    0.05 / 0.012;  // of the stiffness that is missing: slower than pressures follow

/// A pair as one muscle whose current is the difference.
class AsOne final : public RigModel {
 public:
  AsOne(std::unique_ptr<RigModel> pair, const CoContraction& co_contraction)
      : pair_(std::move(pair)), co_contraction_(co_contraction) {}

  std::unique_ptr<RigModel> copy() const override {
    return std::make_unique<AsOne>(pair_->copy(), co_contraction_);
  }
  double given_mA(double wanted_mA) const override { return wanted_mA; }
  void step(const Command& difference, int ticks) override {
    pair_->step(given(difference.current_mA), ticks);
  }
  double contraction_ratio() const override { return pair_->contraction_ratio(); }
  double shown_ratio() const override { return pair_->shown_ratio(); }
  double stiffness_N_m_per_rad() const override { return pair_->stiffness_N_m_per_rad(); }
  void keep() override { pair_->keep(); }
  void go_back() override { pair_->go_back(); }

  /// What the DAC makes of both currents.
  Command given(double difference_mA) const {
    const Command wanted = co_contraction_.command(difference_mA);
    return {pair_->given_mA(wanted.current_mA), pair_->given_mA(wanted.opposite_mA)};
  }

 private:
  std::unique_ptr<RigModel> pair_;
  const CoContraction& co_contraction_;
};

/// The approach to where the target begins, and the ticks on the model.
class PairModelled : public Controller {
 public:
  PairModelled(const PairModelTerms& terms, const std::string& name, const Knowledge& known)
      : terms_(terms),
        known_(terms.within_angles(known)),
        co_contraction_(terms_, known_),
        ahead_ticks_(terms.look_ahead_ticks(known.tick_s)),
        look_(co_contraction_.width_mA(), ahead_ticks_) {
    if (!terms_.model) throw std::invalid_argument(name + ": there is no model");
  }

  Command rest() final { return co_contraction_.command(0.0); }
  std::int64_t preparation_ticks() const final { return std::llround(approach_s / known_.tick_s); }
  Command step(const Reading& reading) final {
    try {
      return drive(reading);
    } catch (const ModelFailure& failure) {
      throw ControllerFailure(std::string("the model cannot be carried on: ") + failure.what());
    }
  }
  bool already_quantised() const final { return true; }

 protected:
  virtual Command drive(const Reading& reading) = 0;

  const Knowledge& known() const { return known_; }
  int ahead_ticks() const { return ahead_ticks_; }
  const CoContraction& co_contraction() const { return co_contraction_; }
  RigModel& model() { return *model_; }
  void begin() {
    model_ = std::make_unique<AsOne>(terms_.model(terms_.assumed_load_kg, rest()), co_contraction_);
    co_contraction_.give(model_->given(0.0));
  }
  bool begun() const { return model_ != nullptr; }

  /// The currents of a tick whose target is moved by so much; the model goes on to the next one.
  Command next(std::int64_t tick, double moved) {
    const std::int64_t ahead = tick + ahead_ticks_;
    co_contraction_.begin_tick(ahead, difference_mA_, further_Pa_);
    const CurrentRange& limits = co_contraction_.differences();
    difference_mA_ =
        look_.current_mA(*model_, known_.target_at(ahead) + moved,
                         std::clamp(difference_mA_, limits.lowest_mA, limits.highest_mA), limits);
    if (const auto wanted = co_contraction_.wanted_N_m_per_rad(tick); wanted && !terms_.co_contraction_Pa)
      further_Pa_ += std::min(share_per_s * known_.tick_s, 1.0) *
                     (*wanted - model_->stiffness_N_m_per_rad()) /
                     co_contraction_.stiffening(known_.target_at(tick));
    const Command command = model_->given(difference_mA_);
    model_->step({difference_mA_}, 1);
    co_contraction_.give(command);
    return command;
  }

 private:
  PairModelTerms terms_;
  Knowledge known_;
  CoContraction co_contraction_;
  int ahead_ticks_;
  LookAhead look_;
  std::unique_ptr<AsOne> model_;
  double difference_mA_ = 0.0, further_Pa_ = 0.0;
};

class PairModelInverse final : public PairModelled {
 public:
  PairModelInverse(const PairModelInverseSettings& settings, const Knowledge& known)
      : PairModelled(settings, settings.name, known), settings_(settings) {}

  void plan() {
    plan_once();
    require_long_enough(ahead_ticks(), known().tick_s, planned_rmse_, [this](int ticks) {
      PairModelInverseSettings other = settings_;
      other.look_ahead_s = ticks * known().tick_s;
      PairModelInverse again(other, known());
      again.plan_once();
      return again.planned_rmse_;
    });
  }

  std::vector<Finding> findings() const override {
    std::vector<Finding> found{{"planned_rmse", "1", planned_rmse_}};
    if (planned_stiffness_) found.push_back({"planned_stiffness_rmse", "N.m/rad", *planned_stiffness_});
    return found;
  }

 private:
  Command drive(const Reading& reading) override {
    if (!begun()) plan();
    const auto last = static_cast<std::int64_t>(plan_.size()) - 1;
    return plan_[static_cast<std::size_t>(std::min(reading.tick + preparation_ticks(), last))];
  }

  void plan_once() {
    begin();
    const auto end = static_cast<std::int64_t>(known().target.size());
    double squares = 0.0, stiffness_squares = 0.0;
    for (std::int64_t k = -preparation_ticks(); k < end; ++k) {
      if (k >= 0) {
        squares += std::pow(model().contraction_ratio() - known().target_at(k), 2);
        if (const auto wanted = co_contraction().wanted_N_m_per_rad(k))
          stiffness_squares += std::pow(model().stiffness_N_m_per_rad() - *wanted, 2);
      }
      plan_.push_back(next(k, 0.0));
    }
    const auto ticks = static_cast<double>(std::max<std::int64_t>(end, 1));
    planned_rmse_ = std::sqrt(squares / ticks);
    if (co_contraction().wanted_N_m_per_rad(0)) planned_stiffness_ = std::sqrt(stiffness_squares / ticks);
  }

  PairModelInverseSettings settings_;
  std::vector<Command> plan_;
  double planned_rmse_ = 0.0;
  std::optional<double> planned_stiffness_;
};

class PairModelInverseFeedback final : public PairModelled {
 public:
  PairModelInverseFeedback(const PairModelInverseFeedbackSettings& settings, const Knowledge& known)
      : PairModelled(settings, settings.name, known),
        terms_(settings),
        believed_(settings.fastest_load_per_s(known), known),
        delayed_(settings.feedback_delay_ticks),
        observer_(settings, known) {}

  std::vector<Finding> findings() const override {
    std::vector<Finding> found = observer_.findings();
    believed_.tell(found);
    return found;
  }

 private:
  Command drive(const Reading& reading) override {
    if (!begun()) {
      PairModelInverse({terms_}, known()).plan();  // of use only if it says that it cannot be followed
      begin();
      observer_.begin(model().shown_ratio());
    }
    const std::int64_t counts = delayed_(believed_(reading.counts));
    observer_.look(model().shown_ratio());
    if (!believed_.lost()) observer_.learn(counts);
    return next(reading.tick, -observer_.unknown());
  }

  PairModelTerms terms_;
  BelievedCounts believed_;
  Delayed<std::int64_t> delayed_;
  ModelObserver observer_;
};

}  // namespace

std::unique_ptr<Controller> PairModelInverseSettings::make(const Knowledge& knowledge) const {
  return std::make_unique<PairModelInverse>(*this, knowledge);
}

std::unique_ptr<Controller> PairModelInverseFeedbackSettings::make(const Knowledge& knowledge) const {
  return std::make_unique<PairModelInverseFeedback>(*this, knowledge);
}

}  // namespace mckibben::controllers
