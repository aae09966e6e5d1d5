// Weighing first; see the header.
#include <cmath>
#include <stdexcept>

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

Command ModelledController::step(const Reading& reading) {
  try {
    return {weigh_or_drive_mA(reading.tick, delayed_(believed_(reading.counts)))};
  } catch (const ModelFailure& failure) {
    throw ControllerFailure(std::string("the model cannot be carried on: ") + failure.what());
  }
}

double ModelledController::weigh_or_drive_mA(std::int64_t tick, std::int64_t counts) {
  if (weighing_ && !weighing_->done()) return weighing_->step_mA(counts);
  if (!begun_) {
    begun_ = true;
    const double before_mA = weighing_ ? weighing_->current_mA() : range_.lowest_mA;
    begin(weighing_ ? weighing_->weighed(terms_.model) : terms_.model(*terms_.assumed_load_kg, {before_mA}),
          tick, before_mA);
  }
  return drive_mA(tick, counts);
}

std::vector<Finding> ModelledController::findings() const {
  std::vector<Finding> found;
  if (weighing_)
    found = {{"weighed_load", "kg", weighing_->load_kg()}, {"weighing_misfit", "1", weighing_->misfit()}};
  believed_.tell(found);
  return found;
}

}  // namespace mckibben::controllers
