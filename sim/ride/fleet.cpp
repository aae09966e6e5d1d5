// Places of convoys, taken once and set off from at each instant; see the header.
#include <map>
#include <stdexcept>

#include <sim/engine/failure.hpp>
#include <sim/ride/fleet.hpp>

namespace mckibben::ride {

Fleet::Fleet(std::span<const Hanging> rigs, std::span<const solver::Settings> settings)
    : settings_(settings.begin(), settings.end()), alone_(rigs.size()), failures_(rigs.size()) {
  if (rigs.size() != settings.size()) throw std::invalid_argument("a fleet wants settings for each rig");
  std::map<ConvoyClass, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    riders_.emplace_back(rigs[i]);
    const plant::Rig* rig = &rigs[i].rig;
    if (const auto in = convoy_class({&rig, 1}, {}, settings[i])) alike[*in].push_back(i);
  }
  for (const auto& [in, members] : alike)
    for (std::size_t first = 0; first < members.size(); first += engine::Convoy::places) {
      const std::size_t count = std::min(engine::Convoy::places, members.size() - first);
      const auto begin = members.begin() + static_cast<std::ptrdiff_t>(first);
      wagons_.push_back({engine::make_convoy(in.remembers, false, in.tolerance, count),
                         {begin, begin + static_cast<std::ptrdiff_t>(count)},
                         {}});
    }
}

void Fleet::require_as_many(std::span<const double> current_mA) const {
  if (current_mA.size() != riders_.size())
    throw std::invalid_argument("a fleet wants a current for each rig");
}

void Fleet::start(std::span<const double> current_mA, double at_s) {
  require_as_many(current_mA);
  time_s_ = at_s;
  failures_.assign(riders_.size(), "");
  for (std::size_t i = 0; i < riders_.size(); ++i) {
    riders_[i].start({{.current_mA = current_mA[i]}, {}, {}}, at_s);
    alone_[i].reset();
  }
  std::vector<bool> seated(riders_.size(), false);
  for (Wagon& wagon : wagons_) {
    wagon.watches.assign(wagon.rigs.size(), {});
    for (std::size_t place = 0; place < wagon.rigs.size(); ++place) {
      const plant::Plant* plant = &riders_[wagon.rigs[place]].plant();
      wagon.convoy->board({&place, 1}, {&plant, 1});
      seated[wagon.rigs[place]] = true;
    }
  }
  for (std::size_t i = 0; i < riders_.size(); ++i)
    if (!seated[i]) alone_[i] = std::make_unique<Ride>(riders_[i], engine::Pace{}, settings_[i]);
}

void Fleet::step(std::span<const double> current_mA, double until_s) {
  require_as_many(current_mA);
  if (!(until_s > time_s_)) throw std::invalid_argument("a fleet goes forward in time");
  time_s_ = until_s;
  for (std::size_t i = 0; i < riders_.size(); ++i) {
    if (!failures_[i].empty()) continue;
    Rider& rider = alone_[i] ? alone_[i]->rider() : riders_[i];
    rider.hold({{.current_mA = current_mA[i]}, {}, {}}, until_s);
  }
  for (std::size_t i = 0; i < riders_.size(); ++i)
    if (alone_[i]) go_alone(i);
  for (Wagon& wagon : wagons_) go(wagon);
}

void Fleet::go(Wagon& wagon) {
  for (std::size_t place = 0; place < wagon.rigs.size(); ++place)
    if (!alone_[wagon.rigs[place]] && failures_[wagon.rigs[place]].empty()) set_off(wagon, place);
  wagon.convoy->go([&](std::size_t place, bool arrived) { come(wagon, place, arrived); });
}

/// As far as what is held goes.
void Fleet::set_off(Wagon& wagon, std::size_t place) {
  Rider& rider = riders_[wagon.rigs[place]];
  const engine::Bound bound{&rider.now.flow, &rider.now.held};
  wagon.convoy->set_off(place, {&bound, 1}, rider.now.time_s, rider.next_s());
}

void Fleet::come(Wagon& wagon, std::size_t place, bool arrived) {
  const std::size_t rig = wagon.rigs[place];
  Rider& rider = riders_[rig];
  if (!arrived) {
    leave(wagon, place, false);
    return go_alone(rig);
  }
  if (!rider.arrive(rider.next_s())) return set_off(wagon, place);
  if (!rider.now.reads) {
    leave(wagon, place, false);  // and fails there, with its reason
    return go_alone(rig);
  }
  const engine::Convoy& convoy = *wagon.convoy;
  if (settings_[rig].method == solver::Method::automatic &&
      wagon.watches[place].is_stiff(convoy.pace(place), convoy.counters(place)))
    leave(wagon, place, true);
}

/// From where it is it goes on alone; a stiff one with the method for these, as the automatic one does.
void Fleet::leave(const Wagon& wagon, std::size_t place, bool stiff) {
  const std::size_t rig = wagon.rigs[place];
  engine::Pace pace = wagon.convoy->pace(place);
  if (stiff) pace.stiff_from_tick = pace.ticks;
  alone_[rig] = std::make_unique<Ride>(riders_[rig], pace, settings_[rig]);
}

void Fleet::go_alone(std::size_t rig) {
  if (!failures_[rig].empty()) return;
  Ride& ride = *alone_[rig];
  try {
    ride.advance();
  } catch (const engine::NumericalFailure& failure) {
    failures_[rig] = failure.what();
  }
  riders_[rig].now = ride.rider().now;
}

}  // namespace mckibben::ride
