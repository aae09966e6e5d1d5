// One step of the PID, after Astrom & Hagglund (PID Controllers, 2nd ed. 1995, sections 3.2 to 3.6).
//
// Counts are the floor of the position, so half a count is added. With integral action the start is bumpless:
// the integral takes up whatever the K term holds at the first reading, so the output begins at rest_current.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <controllers/pid.hpp>

namespace mckibben::controllers {
namespace {

class Pid final : public Controller {
 public:
  Pid(const PidSettings& settings, const Knowledge& knowledge)
      : settings_(settings),
        knowledge_(knowledge),
        K_mA_(*settings.proportional_mA),
        Ti_s_(*settings.integral_time_s),
        Td_s_(*settings.derivative_time_s),
        h_s_(settings.sample_ticks * knowledge.tick_s),
        highest_mA_(std::min(settings.highest_current_mA, knowledge.largest_current_mA)),
        lowest_mA_(std::min(settings.lowest_current_mA, highest_mA_)),
        past_counts_(static_cast<std::size_t>(settings.feedback_delay_ticks) + 1) {
    const double usual_s = Td_s_ > 0.0 ? std::sqrt(Ti_s_ * Td_s_) : Ti_s_;
    Tt_s_ = std::max(settings.tracking_time_s.value_or(usual_s), h_s_);  // faster than a sample would swing
    output_mA_ = clamped(settings.rest_current_mA);
  }

  Command rest() override { return {output_mA_}; }

  Command step(const Reading& reading) override {
    const std::int64_t counts = delayed(reading);
    if (reading.tick % settings_.sample_ticks == 0) output_mA_ = sample(counts, reading.tick);
    return {output_mA_};
  }

 private:
  double clamped(double current_mA) const { return std::clamp(current_mA, lowest_mA_, highest_mA_); }

  // Counts of feedback_delay_ticks ago; before the first reading the rig stood still.
  std::int64_t delayed(const Reading& reading) {
    if (first_) std::fill(past_counts_.begin(), past_counts_.end(), reading.counts);
    past_counts_[oldest_] = reading.counts;
    oldest_ = (oldest_ + 1) % past_counts_.size();
    return past_counts_[oldest_];
  }

  double sample(std::int64_t counts, std::int64_t tick) {
    const double y = (static_cast<double>(counts) + 0.5) * knowledge_.contraction_per_count;
    const double r = knowledge_.target_at(tick);
    const double P_mA = K_mA_ * (settings_.setpoint_weight * r - y);
    if (first_) {
      y_before_ = y;
      if (Ti_s_ > 0.0) I_mA_ = -P_mA;
      first_ = false;
    }
    const double filter_s = Td_s_ + settings_.derivative_filter * h_s_;
    D_mA_ = (Td_s_ * D_mA_ - K_mA_ * Td_s_ * settings_.derivative_filter * (y - y_before_)) / filter_s;
    y_before_ = y;

    const double v_mA = settings_.rest_current_mA + P_mA + I_mA_ + D_mA_;
    const double u_mA = clamped(v_mA);
    if (Ti_s_ > 0.0) I_mA_ += K_mA_ * h_s_ / Ti_s_ * (r - y) + h_s_ / Tt_s_ * (u_mA - v_mA);
    return u_mA;
  }

  PidSettings settings_;
  Knowledge knowledge_;
  double K_mA_, Ti_s_, Td_s_, h_s_;
  double highest_mA_, lowest_mA_;
  double Tt_s_ = 0.0;
  std::vector<std::int64_t> past_counts_;
  std::size_t oldest_ = 0;
  bool first_ = true;
  double y_before_ = 0.0, I_mA_ = 0.0, D_mA_ = 0.0, output_mA_ = 0.0;
};

}  // namespace

std::unique_ptr<Controller> PidSettings::make(const Knowledge& knowledge) const {
  if (needs_tuning()) throw std::invalid_argument(name + ": a gain is missing and was not tuned");
  return std::make_unique<Pid>(*this, knowledge);
}

}  // namespace mckibben::controllers
