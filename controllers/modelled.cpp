// Weighing first; see the header.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <controllers/look_ahead.hpp>
#include <controllers/modelled.hpp>

namespace mckibben::controllers {
namespace {

ModelTerms complete(ModelTerms terms, const CurrentRange& range) {
  terms.follow(range);
  return terms;
}

}  // namespace

RigModel::~RigModel() = default;

ModelledController::ModelledController(const ModelTerms& terms, const std::string& name, int delay_ticks,
                                       const Knowledge& known)
    : terms_(complete(terms, working_range(known))),
      knowledge_(known),
      range_(working_range(known)),
      approach_ticks_(std::llround(approach_s / known.tick_s)),
      believed_(terms.fastest_load_per_s, known),
      delayed_(delay_ticks) {
  if (!terms_.model) throw std::invalid_argument(name + ": there is no model");
  if (!terms_.assumed_load_kg) weighing_.emplace(*terms_.weighing_speed_mA_per_s, delay_ticks, known);
}

std::int64_t ModelledController::preparation_ticks() const {
  return approach_ticks_ + (weighing_ ? weighing_->ticks() : 0);
}

Command ModelledController::rest() {
  try {
    if (!weighing_) begin_at(-preparation_ticks());
  } catch (...) {  // told by its first step
    could_not_begin_ = std::current_exception();
  }
  return {range_.lowest_mA};
}

Command ModelledController::step(const Reading& reading) {
  try {
    if (could_not_begin_) std::rethrow_exception(could_not_begin_);
    return {weigh_or_drive_mA(reading.tick, delayed_(believed_(reading.counts)))};
  } catch (const ModelFailure& failure) {
    throw ControllerFailure(std::string("the model cannot be carried on: ") + failure.what());
  }
}

void ModelledController::begin_at(std::int64_t tick) {
  begun_ = true;
  const double before_mA = weighing_ ? weighing_->current_mA() : range_.lowest_mA;
  begin(weighing_ ? weighing_->weighed(terms_.model) : terms_.model(*terms_.assumed_load_kg, {before_mA}),
        tick, before_mA);
}

double ModelledController::weigh_or_drive_mA(std::int64_t tick, std::int64_t counts) {
  if (weighing_ && !weighing_->done()) return weighing_->step_mA(counts);
  if (!begun_) begin_at(tick);
  return drive_mA(tick, counts);
}

ModelledController::Plan ModelledController::plan(const RigModel& model, std::int64_t tick,
                                                  double before_mA) const {
  const auto looking_ahead = [&](int ticks) { return plan_on(*model.copy(), tick, before_mA, ticks); };
  Plan made = looking_ahead(look_ahead_ticks());
  require_long_enough(look_ahead_ticks(), knowledge_.tick_s, made.rmse,
                      [&](int ticks) { return looking_ahead(ticks).rmse; });
  return made;
}

ModelledController::Plan ModelledController::plan_on(RigModel& model, std::int64_t tick, double before_mA,
                                                     int ahead_ticks) const {
  LookAhead look(range_.width_mA(), ahead_ticks);
  const auto end = static_cast<std::int64_t>(knowledge_.target.size());
  Plan made;
  double squares = 0.0;
  for (std::int64_t k = tick; k < end; ++k) {
    before_mA =
        model.given_mA(look.current_mA(model, aim(k, ahead_ticks), before_mA, range_after(before_mA)));
    if (k >= 0) squares += std::pow(model.contraction_ratio() - knowledge_.target_at(k), 2);
    model.step({before_mA}, 1);
    made.currents_mA.push_back(before_mA);
  }
  made.rmse = std::sqrt(squares / static_cast<double>(std::max<std::int64_t>(end, 1)));
  return made;
}

std::vector<Finding> ModelledController::findings() const {
  std::vector<Finding> found;
  if (weighing_)
    found = {{"weighed_load", "kg", weighing_->load_kg()}, {"weighing_misfit", "1", weighing_->misfit()}};
  believed_.tell(found);
  return found;
}

}  // namespace mckibben::controllers
