// The loop begins alone, as PID does, and finds the load out as it goes (load_in_loop.hpp), unless it is
// told. Fed forward is
//   - what the derivative takes away from a motion that is wanted, since it acts on counts; of a target that
//     jumps, as much as the rig can follow;
//   - how the model's current changes along the target, between its two branches and a lag ahead: only
//     changes, so where it is wrong by a constant the integral need not undo it;
//   - while the target moves, some of what the threads hold.
// The last two near an end of the calibrated contraction ratios count less, beyond it, or under a load that
// was not calibrated, not at all; the loop goes on alone from where it is.
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <controllers/delayed.hpp>
#include <controllers/feedforward_pid.hpp>
#include <controllers/kept_safe.hpp>
#include <controllers/load_in_loop.hpp>

namespace mckibben::controllers {
namespace {

constexpr double fading_share = 0.1;   // of the calibrated contraction ratios, at each end
constexpr double threads_share = 0.5;  // of half their band: with too much the load runs ahead
constexpr double slow_per_s = 0.01;    // a target as slow as this does not tell for sure which way they pull

class FeedforwardPid final : public Controller {
 public:
  FeedforwardPid(const FeedforwardPidSettings& settings, const Knowledge& known)
      : range_(settings.model.range),
        model_(settings.model),
        known_(allowed(settings, known)),
        loop_(settings, known),
        load_(settings.model, known_),
        believed_(settings.fastest_load_per_s, known),
        delayed_(settings.feedback_delay_ticks),
        braking_mA_s_(*settings.proportional_mA * *settings.derivative_time_s),
        is_told_(settings.assumed_load_kg.has_value()),
        reach_(known.reach.at_load(range_.lowest_load_kg)),
        led_ratio_(known_.target_at(0)) {
    base_mA_ = loop_.clamped(working_range(known).lowest_mA);
    if (!is_told_) return;
    believe(*settings.assumed_load_kg, 0.0);
    const double first_Pa = (*inverse_)(Branch::contraction, led_ratio_, 0.0).pressure_Pa;
    base_mA_ = loop_.clamped(known.valve.current_mA(first_Pa));
  }

  Command rest() override { return {output_mA_ = base_mA_}; }

  Command step(const Reading& reading) override {
    if (!is_told_) {
      const std::int64_t counts = delayed_(believed_(reading.counts));
      load_.see(reading.tick, counts, output_mA_, !believed_.lost() && loop_.inside_limits(output_mA_));
      if (const auto found_kg = load_.load_kg(); found_kg && found_kg != found_kg_)
        believe(*(found_kg_ = found_kg), weighing_tolerance);
    }
    const auto tick = static_cast<double>(reading.tick);
    const double threads_mA = lead(at(tick + lag_ticks(at(tick))));
    return {output_mA_ = loop_.step(reading, base_mA_ + threads_mA + braking_mA_s_ * speed_per_s(tick))};
  }

  std::vector<Finding> findings() const override {
    std::vector<Finding> found;
    if (found_kg_) found.push_back({"found_load", "kg", *found_kg_});
    if (inverse_) found.push_back({"believed_load", "kg", believed_kg_});
    found.push_back({"load_extrapolated", "1", inverse_ && !calibrated_ ? 1.0 : 0.0});
    found.push_back({"ticks_feedforward_faded", "1", static_cast<double>(faded_ticks_)});
    loop_.tell(found);
    return found;
  }

 private:
  /// A load that may be wrong by a share of itself is taken as the range's end if it lies no further outside.
  void believe(double load_kg, double tolerance) {
    const double within_kg = std::clamp(load_kg, range_.lowest_load_kg, range_.highest_load_kg);
    calibrated_ = std::abs(load_kg - within_kg) <= tolerance * load_kg;
    believed_kg_ = calibrated_ ? within_kg : load_kg;
    inverse_.emplace(model_, believed_kg_, known_.valve, false);
    reach_ = known_.reach.at_load(believed_kg_);
  }

  double believed_at(double ratio) const {
    if (!inverse_ || !calibrated_) return 0.0;
    const double low = range_.lowest_ratio, high = range_.highest_ratio;
    return std::clamp(std::min(ratio - low, high - ratio) / (fading_share * (high - low)), 0.0, 1.0);
  }

  /// Moves the base to where the target will be, and gives the current against the threads on the way there.
  double lead(double ratio) {
    const double before = std::exchange(led_ratio_, ratio);
    const double share = std::min(believed_at(before), believed_at(ratio));
    faded_ticks_ += ratio != before && share < 1.0 ? 1 : 0;
    if (share == 0.0) return 0.0;
    base_mA_ +=
        share * (balanced_mA(*inverse_, known_.valve, ratio) - balanced_mA(*inverse_, known_.valve, before));
    const double direction = std::tanh((ratio - before) / known_.tick_s / slow_per_s);
    return share * threads_share * direction * half_band_mA(ratio);
  }

  /// Half of what lies between the branches of a current that stands still, where no lag is in them.
  double half_band_mA(double ratio) const {
    const auto of = [&](Branch branch) {
      return known_.valve.current_mA(inverse_->pressure_Pa(branch, ratio, 0.0));
    };
    return std::max(0.5 * (of(Branch::contraction) - of(Branch::relaxation)), 0.0);
  }

  /// Half a tick is added: a current is held for a tick, so on average it is that old.
  double lag_ticks(double ratio) const {
    const double lag_s = 0.5 * (known_.reach.at_ratio(reach_.rising_lag_s, ratio) +
                                known_.reach.at_ratio(reach_.falling_lag_s, ratio));
    return lag_s / known_.tick_s + 0.5;
  }

  /// Of the target, no faster than the rig can follow.
  double speed_per_s(double tick) const {
    return std::clamp((at(tick) - at(tick - 1.0)) / known_.tick_s,
                      -known_.reach.at_ratio(reach_.falling_per_s, at(tick)),
                      known_.reach.at_ratio(reach_.rising_per_s, at(tick)));
  }

  /// The target between two ticks.
  double at(double tick) const {
    const double whole = std::floor(tick);
    const auto k = static_cast<std::int64_t>(whole);
    return std::lerp(known_.target_at(k), known_.target_at(k + 1), tick - whole);
  }

  CalibratedRange range_;
  Calibration model_;
  Knowledge known_;
  PidLoop loop_;
  LoadInLoop load_;
  BelievedCounts believed_;
  Delayed<std::int64_t> delayed_;
  double braking_mA_s_;
  bool is_told_, calibrated_ = false;
  ReachOfLoad reach_;  // of the lightest load until one is believed
  std::optional<Inverse> inverse_;
  std::optional<double> found_kg_;
  double believed_kg_ = 0.0, base_mA_ = 0.0, output_mA_ = 0.0;
  double led_ratio_;  // where the base has been brought
  std::int64_t faded_ticks_ = 0;
};

}  // namespace

std::unique_ptr<Controller> FeedforwardPidSettings::make(const Knowledge& knowledge) const {
  if (knowledge.reach.empty()) throw std::invalid_argument(name + ": what is reachable was not computed");
  return std::make_unique<FeedforwardPid>(*this, knowledge);
}

}  // namespace mckibben::controllers
