// Only changes of the model's current are fed forward, and between its two branches: where it is wrong by a
// constant, or about what the threads hold, the integral need not undo it. A step that the target takes near
// an end of the calibrated contraction ratios counts less, beyond it, or under a load that was not
// calibrated, not at all; the loop goes on alone from where it is. The loop is closed as soon as the load is
// known.
#include <algorithm>

#include <controllers/feedforward_pid.hpp>

namespace mckibben::controllers {
namespace {

constexpr double fading_share = 0.1;  // of the calibrated contraction ratios, at each end

class FeedforwardPid final : public CalibratedController {
 public:
  FeedforwardPid(const FeedforwardPidSettings& settings, const Knowledge& known)
      : CalibratedController(settings, known), loop_(settings, known) {}

  std::vector<Finding> findings() const override {
    std::vector<Finding> found = CalibratedController::findings();
    found.push_back({"ticks_feedforward_faded", "1", static_cast<double>(faded_ticks_)});
    if (loop_.lost_ticks() > 0)
      found.push_back({"ticks_without_counts", "1", static_cast<double>(loop_.lost_ticks())});
    return found;
  }

 private:
  double first_mA() override { return base_mA_ = loop_.clamped(begin_mA(knowledge().target_at(0))); }
  double settle_mA(const Reading& reading, double way_mA) override { return loop_.step(reading, way_mA); }
  double drive_mA(const Reading& reading) override {
    const double before = knowledge().target_at(std::max<std::int64_t>(reading.tick - 1, 0)),
                 now = knowledge().target_at(reading.tick);
    const double share = std::min(believed_at(before), believed_at(now));
    faded_ticks_ += now != before && share < 1.0 ? 1 : 0;
    base_mA_ += share * (balanced_mA(now) - balanced_mA(before));
    return loop_.step(reading, base_mA_);
  }

  double believed_at(double ratio) const {
    if (!load_is_calibrated()) return 0.0;
    const double low = range().lowest_ratio, high = range().highest_ratio;
    return std::clamp(std::min(ratio - low, high - ratio) / (fading_share * (high - low)), 0.0, 1.0);
  }

  PidLoop loop_;
  double base_mA_ = 0.0;
  std::int64_t faded_ticks_ = 0;
};

}  // namespace

std::unique_ptr<Controller> FeedforwardPidSettings::make(const Knowledge& knowledge) const {
  return std::make_unique<FeedforwardPid>(*this, knowledge);
}

}  // namespace mckibben::controllers
