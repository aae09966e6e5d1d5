// Lanes are taken by the next item as they become free; see the header.
#include <algorithm>
#include <optional>
#include <utility>

#include <sim/ride/batch.hpp>
#include <sim/ride/ride.hpp>

namespace mckibben::ride {

BatchKey batch_key(std::span<const Rider> riders, const Drive& drive, const solver::Settings& settings,
                   bool keep_ledger) {
  BatchKey key{.in_lanes = riders.size() <= engine::Batch::width && settings.method != solver::Method::cvode,
               .shape = {.keep_ledger = keep_ledger},
               .method = settings.method,
               .tolerance = settings.tolerance,
               .given = drive.given(),
               .opposite_given = drive.opposite.given(),
               .length_is_given = drive.contraction_ratio.has_value()};
  std::vector<const plant::Plant*> plants;
  for (const Rider& rider : riders) {
    const plant::Plant& plant = rider.plant();
    key.shape.pairs = plant.opposite().has_value();
    key.shape.memories = std::max(key.shape.memories, plant.memories());
    const bool no_ledger = key.shape.pairs || plant.rig().effects.warm();
    if (plant.has_events() || (keep_ledger && no_ledger)) key.in_lanes = false;
    plants.push_back(&plant);
  }
  // Such rigs are few, and each kind of lanes takes long to compile.
  if (key.shape.memories == plant::Memories::all && (key.shape.pairs || keep_ledger)) key.in_lanes = false;
  if (!key.in_lanes) return key;
  auto kind = engine::kind_of(plants);
  key.shape.mixed = !kind;
  key.kind = std::move(kind).value_or(engine::Kind{});
  return key;
}

Alone::Alone(std::span<const Rider> riders, const BatchKey& key, const engine::Pace* pace,
             const engine::Counters& before)
    : before_(before) {
  for (const Rider& rider : riders)
    integrators_.push_back(
        engine::make_integrator(rider.plant(), {key.method, key.tolerance}, key.shape.keep_ledger));
  if (pace != nullptr) integrators_.front()->resume(*pace);
}

void Alone::run(BatchItem& item, bool holds) {
  std::optional<engine::NumericalFailure> failure;
  try {
    while (std::exchange(holds, false) || item.go_on()) ride::advance(item.riders(), integrators_);
  } catch (const engine::NumericalFailure& why) {
    failure = why;
  }
  item.end(before_ + integrators_.front()->counters(), failure ? &*failure : nullptr);
}

Batch::Batch(BatchKey key, std::size_t lanes, bool resumable)
    : key_(std::move(key)),
      resumable_(resumable),
      lanes_(engine::make_batch(key_.shape, key_.tolerance, lanes)) {}

void Batch::run(const Next& next) {
  for (std::size_t slot = 0; resumable_ && slot < slots_.size(); ++slot) {
    if (slots_[slot].alone)
      slots_[slot].alone->run(*slots_[slot].item);
    else if (slots_[slot].item)
      go_on(slot);
  }
  fill(next);
  lanes_->run([&](std::size_t slot, bool arrived) { arrive(slot, arrived, next); });
}

/// Submits items as long as there is room for the next one.
void Batch::fill(const Next& next) {
  if (!waiting_) waiting_ = next();
  while (waiting_ && submit(waiting_)) waiting_ = next();
}

bool Batch::submit(const std::shared_ptr<BatchItem>& item, const Carried& from) {
  std::array<const plant::Plant*, engine::Batch::width> plants{};
  const auto riders = item->riders();
  for (std::size_t i = 0; i < riders.size(); ++i) plants[i] = &riders[i].plant();
  const auto slot = lanes_->submit(std::span(plants).first(riders.size()));
  if (!slot) return false;
  slots_[*slot].item = item;
  if (from.alone)
    slots_[*slot].alone = std::make_unique<Alone>(riders, key_, &from.pace);
  else
    lanes_->resume(*slot, from.pace);
  go_on(*slot);
  return true;
}

std::optional<Carried> Batch::carried(const BatchItem& item) const {
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    const auto& [here, alone] = slots_[slot];
    if (here.get() == &item) return Carried{alone ? alone->pace() : lanes_->pace(slot), alone != nullptr};
  }
  return std::nullopt;
}

void Batch::arrive(std::size_t slot, bool arrived, const Next& next) {
  const auto riders = slots_[slot].item->riders();
  if (!arrived)
    evict(slot, false);
  else if (!ride::arrive(riders, next_s(riders)))
    return advance(slot);
  else if (std::ranges::any_of(riders, [](const Rider& rider) { return !rider.now.reads; }))
    evict(slot, false);  // and fails there, with its reason
  else
    go_on(slot);
  if (!slots_[slot].item) fill(next);
}

void Batch::go_on(std::size_t slot) {
  BatchItem& item = *slots_[slot].item;
  if (!item.go_on()) {
    item.end(lanes_->counters(slot), nullptr);
    if (!resumable_) leave(slot);
  } else if (key_.method == solver::Method::automatic && item.riders().size() == 1 &&
             lanes_->is_stiff(slot)) {
    evict(slot, true);
  } else {
    advance(slot);
  }
}

/// As far as what is held goes.
void Batch::advance(std::size_t slot) {
  const auto riders = slots_[slot].item->riders();
  std::array<engine::Bound, engine::Batch::width> bound{};
  for (std::size_t i = 0; i < riders.size(); ++i) bound[i] = {&riders[i].now.flow, &riders[i].now.held};
  lanes_->advance(slot, std::span(bound).first(riders.size()), riders.front().now.time_s, next_s(riders));
}

/// One rig goes on alone, a stiff one with the method for these, as the automatic one does; several fail.
void Batch::evict(std::size_t slot, bool stiff) {
  auto& [item, alone] = slots_[slot];
  const auto riders = item->riders();
  engine::Pace pace = lanes_->pace(slot);
  if (stiff) pace.stiff_from_tick = pace.ticks;
  if (riders.size() > 1) {
    const Rider::State& now = riders.front().now;
    const engine::NumericalFailure failure(
        now.time_s, now.flow.state,
        "rigs in common steps find none that is small enough, or one has no reading");
    item->end(lanes_->counters(slot), &failure);
  } else {
    alone = std::make_unique<Alone>(riders, key_, &pace, lanes_->counters(slot));
    alone->run(*item, true);
  }
  if (!resumable_) leave(slot);
}

void Batch::leave(std::size_t slot) {
  lanes_->evict(slot);
  slots_[slot] = {};
}

}  // namespace mckibben::ride
