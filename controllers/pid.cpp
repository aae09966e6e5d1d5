// One step of the PID, after Astrom & Hagglund (PID Controllers, 2nd ed. 1995, sections 3.2 to 3.6).
//
// Counts are the floor of the position, so half a count is added. With integral action the start is bumpless:
// the integral takes up whatever the K term holds at the first reading, so the output begins at its base.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <controllers/pid.hpp>

namespace mckibben::controllers {
namespace {

double given(const std::optional<double>& gain) {
  if (!gain) throw std::invalid_argument("a gain is missing and was not tuned");
  return *gain;
}

class Pid final : public Controller {
 public:
  Pid(const PidSettings& settings, const Knowledge& knowledge)
      : loop_(settings, knowledge), rest_mA_(*settings.rest_current_mA) {}

  Command rest() override { return {loop_.clamped(rest_mA_)}; }
  Command step(const Reading& reading) override { return {loop_.step(reading, rest_mA_)}; }
  std::vector<Finding> findings() const override {
    std::vector<Finding> found;
    loop_.tell(found);
    return found;
  }

 private:
  PidLoop loop_;
  double rest_mA_;
};

PidTerms followed(PidTerms terms, const Knowledge& knowledge) {
  terms.follow(working_range(knowledge));
  return terms;
}

}  // namespace

void PidSettings::follow(const CurrentRange& range) {
  PidTerms::follow(range);
  RestTerms::follow(*this, range);
}

PidLoop::PidLoop(const PidTerms& terms, const Knowledge& knowledge)
    : terms_(followed(terms, knowledge)),
      knowledge_(knowledge),
      K_mA_(given(terms.proportional_mA)),
      Ti_s_(given(terms.integral_time_s)),
      Td_s_(given(terms.derivative_time_s)),
      h_s_(terms.sample_ticks * knowledge.tick_s),
      limits_(terms_.within(knowledge)),
      believed_(terms.fastest_load_per_s, knowledge),
      delayed_(terms.feedback_delay_ticks) {
  const double usual_s = Td_s_ > 0.0 ? std::sqrt(Ti_s_ * Td_s_) : Ti_s_;
  Tt_s_ = std::max(terms.tracking_time_s.value_or(usual_s), h_s_);  // faster than a sample would swing
}

double PidLoop::clamped(double current_mA) const {
  return std::clamp(current_mA, limits_.lowest_mA, limits_.highest_mA);
}

double PidLoop::step(const Reading& reading, double base_mA) {
  return step(reading, base_mA, limits_);
}

double PidLoop::step(const Reading& reading, double base_mA, const CurrentRange& limits) {
  const std::int64_t counts = delayed_(believed_(reading.counts));
  if (believed_.lost()) return output_mA_;
  if (first_ || reading.tick % terms_.sample_ticks == 0)
    output_mA_ = sample(counts, reading.tick, base_mA, limits);
  return output_mA_;
}

double PidLoop::sample(std::int64_t counts, std::int64_t tick, double base_mA, const CurrentRange& limits) {
  const double y =
      (static_cast<double>(counts) + knowledge_.middle_of_count) * knowledge_.contraction_per_count;
  const double r = terms_.allowed(knowledge_.target_at(tick));
  const bool rests = terms_.dead_zone && std::abs(r - y) <= *terms_.dead_zone;
  const double error = rests ? 0.0 : r - y;
  const double P_mA = K_mA_ * (terms_.setpoint_weight * r - (rests ? r : y));
  const bool begins = first_;
  if (first_) {
    y_before_ = y;
    if (Ti_s_ > 0.0) I_mA_ = -P_mA;
    first_ = false;
  }
  const double filter_s = Td_s_ + terms_.derivative_filter * h_s_;
  D_mA_ = (Td_s_ * D_mA_ - K_mA_ * Td_s_ * terms_.derivative_filter * (y - y_before_)) / filter_s;
  if (rests) D_mA_ = 0.0;
  y_before_ = y;

  const double v_mA = base_mA + P_mA + I_mA_ + D_mA_;
  const CurrentRange reach = begins ? limits : terms_.within_reach(limits, output_mA_, h_s_);
  const double u_mA = std::clamp(v_mA, reach.lowest_mA, reach.highest_mA);
  if (Ti_s_ > 0.0) I_mA_ += K_mA_ * h_s_ / Ti_s_ * error + h_s_ / Tt_s_ * (u_mA - v_mA);
  return u_mA;
}

std::unique_ptr<Controller> PidSettings::make(const Knowledge& knowledge) const {
  PidSettings settings = *this;
  settings.follow(working_range(knowledge));
  return std::make_unique<Pid>(settings, knowledge);
}

}  // namespace mckibben::controllers
