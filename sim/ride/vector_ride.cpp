// Items that keep their lanes from instant to instant; see the header.
#include <algorithm>
#include <stdexcept>

#include <sim/ride/vector_ride.hpp>

namespace mckibben::ride {

struct VectorRide::Member final : BatchItem {
  explicit Member(const Loaded& rig) : rider(rig) {}

  std::span<Rider> riders() override { return {&rider, 1}; }
  bool go_on() override { return std::exchange(holds, false); }
  void end(const engine::Counters&, const engine::NumericalFailure* why) override {
    if (why != nullptr) failure = why->what();
  }

  Rider rider;
  bool holds = false;
  std::string failure;
};

VectorRide::VectorRide(std::span<const Loaded> rigs, std::span<const solver::Settings> settings) {
  if (rigs.size() != settings.size()) throw std::invalid_argument("rigs and settings are not as many");
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    members_.push_back(std::make_shared<Member>(rigs[i]));
    alike_[batch_key(members_.back()->riders(), {}, settings[i])].push_back(i);
  }
}

void VectorRide::require_as_many(std::size_t given) const {
  if (given != rigs()) throw std::invalid_argument("one for each rig is wanted");
}

void VectorRide::start(std::span<const double> current_mA, double at_s) {
  require_as_many(current_mA.size());
  time_s_ = at_s;
  for (std::size_t i = 0; i < rigs(); ++i) {
    Member& member = *members_[i];
    member.rider.start({{.current_mA = current_mA[i]}, {}, {}}, at_s);
    member.holds = false;
    member.failure.clear();
  }
  carry([](std::size_t) { return Carried{}; });
}

VectorRide::Saved VectorRide::save(std::size_t rig) const {
  const auto& member = members_[rig];
  Saved saved{member->rider.now, {}, member->failure};
  for (const auto& [item, alone] : alone_)
    if (item == member) saved.carried.pace = alone.pace();
  for (const Batch& batch : batches_)
    if (const auto carried = batch.carried(*member)) saved.carried = *carried;
  return saved;
}

void VectorRide::resume(std::span<const Saved> saved, double at_s) {
  require_as_many(saved.size());
  time_s_ = at_s;
  for (std::size_t i = 0; i < rigs(); ++i) {
    Member& member = *members_[i];
    member.rider.now = saved[i].rider;
    member.holds = false;
    member.failure = saved[i].failure;
  }
  carry([&](std::size_t rig) { return saved[rig].carried; });
}

void VectorRide::carry(const std::function<Carried(std::size_t rig)>& from) {
  batches_.clear();
  alone_.clear();
  constexpr std::size_t most = engine::Batch::most_lanes;
  for (const auto& [key, all] : alike_)
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto& member = members_[all[k]];
      if (!key.in_lanes) {
        const engine::Pace pace = from(all[k]).pace;
        alone_.emplace_back(member, Alone(member->riders(), key, &pace));
        continue;
      }
      if (k % most == 0) batches_.emplace_back(key, std::min(most, all.size() - k), true);
      batches_.back().submit(member, from(all[k]));
    }
}

void VectorRide::step(std::span<const double> current_mA, double until_s) {
  require_as_many(current_mA.size());
  if (!(until_s > time_s_)) throw std::invalid_argument("time goes forward");
  time_s_ = until_s;
  for (std::size_t i = 0; i < rigs(); ++i) {
    Member& member = *members_[i];
    if (!member.failure.empty()) continue;
    member.rider.hold({{.current_mA = current_mA[i]}, {}, {}}, until_s);
    member.holds = true;
  }
  for (auto& [member, alone] : alone_) alone.run(*member);
  for (Batch& batch : batches_) batch.run();
}

void VectorRide::retire(std::size_t rig) {
  members_[rig]->failure = "retired";
}

const Rider& VectorRide::rider(std::size_t rig) const {
  return members_[rig]->rider;
}
const std::string& VectorRide::failure(std::size_t rig) const {
  return members_[rig]->failure;
}

}  // namespace mckibben::ride
