// The loop begins alone, as PID does, and finds the load out as it goes (load_in_loop.hpp), unless it is
// told. Only changes of the model's current are fed forward, and between its two branches: where it is wrong
// by a constant, or about what the threads hold, the integral need not undo it. A step that the target takes
// near an end of the calibrated contraction ratios counts less, beyond it, or under a load that was not
// calibrated, not at all; the loop goes on alone from where it is.
#include <algorithm>
#include <cmath>
#include <optional>

#include <controllers/feedforward_pid.hpp>
#include <controllers/load_in_loop.hpp>

namespace mckibben::controllers {
namespace {

constexpr double fading_share = 0.1;  // of the calibrated contraction ratios, at each end

class FeedforwardPid final : public Controller {
 public:
  FeedforwardPid(const FeedforwardPidSettings& settings, const Knowledge& known)
      : range_(settings.model.range),
        model_(settings.model),
        known_(known),
        loop_(settings, known),
        load_(settings.model, known),
        is_told_(settings.assumed_load_kg.has_value()) {
    base_mA_ = loop_.clamped(working_range(known).lowest_mA);
    if (!is_told_) return;
    believe(*settings.assumed_load_kg, 0.0);
    const double first_Pa = (*inverse_)(Branch::contraction, known.target_at(0), 0.0).pressure_Pa;
    base_mA_ = loop_.clamped(known.valve.current_mA(first_Pa));
  }

  Command rest() override { return {output_mA_ = base_mA_}; }

  Command step(const Reading& reading) override {
    if (!is_told_) {
      load_.see(reading.tick, reading.counts, output_mA_, loop_.inside_limits(output_mA_));
      if (const auto found_kg = load_.load_kg(); found_kg && found_kg != found_kg_)
        believe(*(found_kg_ = found_kg), weighing_tolerance);
    }
    const double before = known_.target_at(std::max<std::int64_t>(reading.tick - 1, 0)),
                 now = known_.target_at(reading.tick);
    const double share = std::min(believed_at(before), believed_at(now));
    faded_ticks_ += now != before && share < 1.0 ? 1 : 0;
    if (share > 0.0)
      base_mA_ +=
          share * (balanced_mA(*inverse_, known_.valve, now) - balanced_mA(*inverse_, known_.valve, before));
    return {output_mA_ = loop_.step(reading, base_mA_)};
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
  }

  double believed_at(double ratio) const {
    if (!inverse_ || !calibrated_) return 0.0;
    const double low = range_.lowest_ratio, high = range_.highest_ratio;
    return std::clamp(std::min(ratio - low, high - ratio) / (fading_share * (high - low)), 0.0, 1.0);
  }

  CalibratedRange range_;
  Calibration model_;
  Knowledge known_;
  PidLoop loop_;
  LoadInLoop load_;
  bool is_told_, calibrated_ = false;
  std::optional<Inverse> inverse_;
  std::optional<double> found_kg_;
  double believed_kg_ = 0.0, base_mA_ = 0.0, output_mA_ = 0.0;
  std::int64_t faded_ticks_ = 0;
};

}  // namespace

std::unique_ptr<Controller> FeedforwardPidSettings::make(const Knowledge& knowledge) const {
  return std::make_unique<FeedforwardPid>(*this, knowledge);
}

}  // namespace mckibben::controllers
