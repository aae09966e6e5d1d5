// Weighing, the way to the first current, and the inverse tick by tick.
#include <algorithm>
#include <cmath>
#include <sstream>

#include <controllers/calibrated.hpp>

namespace mckibben::controllers {
namespace {

constexpr double settling_s = 1.0;  // at the first current, before tick 0

}  // namespace

void CalibratedSettings::follow(const CurrentRange& range) {
  const bool open = !weighing.speed_mA_per_s;
  weighing.follow(range);
  const double lowest = model.range.lowest_speed_mA_per_s, highest = model.range.highest_speed_mA_per_s;
  if (open && highest > 0.0) weighing.speed_mA_per_s = std::clamp(*weighing.speed_mA_per_s, lowest, highest);
}

CalibratedController::CalibratedController(const CalibratedSettings& settings, const Knowledge& knowledge)
    : settings_(settings), knowledge_(knowledge) {
  settings_.follow(working_range(knowledge));
  if (!settings.assumed_load_kg) weighing_.emplace(settings.weighing, settings.model, knowledge);
}

Command CalibratedController::rest() {
  if (weighing_) return {weighing_->current_mA(0)};
  know(*settings_.assumed_load_kg);
  return {first_mA_};
}

// Five contractions, then time enough for any first current and for coming to rest there.
std::int64_t CalibratedController::preparation_ticks() const {
  if (!weighing_) return 0;
  const ValveLine& valve = knowledge_.valve;
  const double way_s = (valve.span_current_mA - valve.zero_current_mA) / *settings_.weighing.speed_mA_per_s;
  return weighing_->ticks() + std::llround((way_s + settling_s) / knowledge_.tick_s);
}

Command CalibratedController::step(const Reading& reading) {
  if (reading.tick >= 0) {
    if (!inverse_) rest();
    return {drive_mA(reading)};
  }
  const std::int64_t tick = reading.tick + preparation_ticks();
  if (tick < weighing_->ticks()) {
    weighing_->see(tick, reading.counts);
    return {weighing_->current_mA(tick)};
  }
  if (!inverse_) {
    weighed_ = weighing_->result();
    know(weighed_->load_kg);
  }
  const double low_mA = *settings_.weighing.low_mA;
  const double way_mA =
      static_cast<double>(tick - weighing_->ticks()) * knowledge_.tick_s * *settings_.weighing.speed_mA_per_s;
  return {std::min(first_mA_, low_mA + way_mA)};
}

// A calibrated load must not be refused, or extrapolated, because it was weighed a little wrong: it is taken
// as the range's end.
void CalibratedController::know(double load_kg) {
  const CalibratedRange& range = settings_.model.range;
  const double within_kg = std::clamp(load_kg, range.lowest_load_kg, range.highest_load_kg);
  const double tolerance_kg = weighing_ ? weighing_tolerance * load_kg : 0.0;
  const bool near = std::abs(load_kg - within_kg) <= tolerance_kg;
  if (!near && !settings_.extrapolate_load) {
    std::ostringstream text;
    text << (weighing_ ? "the load was weighed as " : "the load is assumed to be ") << load_kg
         << " kg; the calibration was made with loads from " << range.lowest_load_kg << " to "
         << range.highest_load_kg
         << " kg. Calibrate with loads on both sides of it, or allow it with extrapolate_load: true";
    throw ControllerFailure(text.str());
  }
  load_extrapolated_ = !near;
  load_at_range_end_ = near && within_kg != load_kg;
  load_kg_ = near ? within_kg : load_kg;
  inverse_.emplace(settings_.model, load_kg_, knowledge_.valve, settings_.extrapolate_target);
  prepare();
  first_mA_ = first_mA();
}

double CalibratedController::current_of(Branch branch, const Answer& answer, double lag_s) const {
  const double behind_Pa = knowledge_.valve.slope_Pa_per_mA() * answer.current_speed_mA_per_s * lag_s;
  const double pressure_Pa = answer.pressure_Pa + (branch == Branch::contraction ? -behind_Pa : behind_Pa);
  return knowledge_.valve.current_mA(pressure_Pa);
}

double CalibratedController::ask_mA(Branch branch, double contraction_ratio, double contraction_speed_per_s,
                                    double lag_s) {
  const Answer answer = (*inverse_)(branch, contraction_ratio, contraction_speed_per_s);
  ratio_outside_ += answer.ratio_outside ? 1 : 0;
  speed_outside_ += answer.speed_outside ? 1 : 0;
  extrapolated_ += settings_.extrapolate_target && (answer.ratio_outside || answer.speed_outside) ? 1 : 0;
  unreachable_ += answer.unreachable ? 1 : 0;
  asked_ratio_ = contraction_ratio;
  return current_mA_ = current_of(branch, answer, lag_s);
}

double CalibratedController::begin_mA(double contraction_ratio, double lag_s) {
  asked_ratio_ = contraction_ratio;
  const Answer answer = (*inverse_)(Branch::contraction, contraction_ratio, 0.0);
  return current_mA_ = current_of(Branch::contraction, answer, lag_s);
}

// The branch is chosen by the target's direction. While it rests the threads hold the load where it is, and
// neither branch describes that.
double CalibratedController::follow_mA(double contraction_ratio) {
  if (contraction_ratio == asked_ratio_) return current_mA_;
  const double speed_per_s = (contraction_ratio - asked_ratio_) / knowledge_.tick_s;
  return ask_mA(speed_per_s > 0.0 ? Branch::contraction : Branch::relaxation, contraction_ratio, speed_per_s);
}

std::vector<Finding> CalibratedController::findings() const {
  std::vector<Finding> found;
  if (weighed_) {
    found.push_back({"weighed_load", "kg", weighed_->load_kg});
    found.push_back({"weighed_load_spread", "kg", weighed_->spread_kg});
  }
  if (weighing_ && inverse_) {
    found.push_back({"believed_load", "kg", load_kg_});
  }
  const auto count = [](std::int64_t ticks) { return static_cast<double>(ticks); };
  found.push_back({"load_extrapolated", "1", load_extrapolated_ ? 1.0 : 0.0});
  found.push_back({"load_taken_as_range_end", "1", load_at_range_end_ ? 1.0 : 0.0});
  found.push_back({"ticks_outside_calibrated_contraction", "1", count(ratio_outside_)});
  found.push_back({"ticks_outside_calibrated_speed", "1", count(speed_outside_)});
  found.push_back({"ticks_extrapolated", "1", count(extrapolated_)});
  found.push_back({"ticks_unreachable", "1", count(unreachable_)});
  return found;
}

}  // namespace mckibben::controllers
