// Places are taken by the next party as they become free; see the header.
#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include <sim/ride/convoy.hpp>

namespace mckibben::ride {
namespace {

class Carrying {
 public:
  Carrying(const std::function<Party*()>& next, const ConvoyClass& all, std::size_t places)
      : next_(next),
        may_turn_stiff_(all.method == solver::Method::automatic),
        places_(places),
        convoy_(engine::make_convoy(all.remembers, all.keep_ledger, all.tolerance, places)) {}

  void operator()() {
    fill();
    convoy_->go([this](std::size_t place, bool arrived) { come(place, arrived); });
  }

 private:
  struct Seats {
    Party* party = nullptr;  ///< that has its first place here
    std::array<std::size_t, engine::Convoy::wing> places{};
    std::size_t count = 0;
    StiffWatch watch{};
  };

  /// Seats parties as long as there is room for the next one.
  void fill() {
    for (;;) {
      if (waiting_ == nullptr) waiting_ = next_();
      if (waiting_ == nullptr || !seat(*waiting_)) return;
      waiting_ = nullptr;
    }
  }

  /// False if there is no room. The party sets off, unless it has come to its end.
  bool seat(Party& party) {
    const auto riders = party.riders();
    Seats seats{.party = &party};
    for (std::size_t place = 0; place < places_ && seats.count < riders.size(); ++place)
      if (!taken_[place]) seats.places[seats.count++] = place;
    if (seats.count < riders.size()) return false;
    std::array<const plant::Plant*, engine::Convoy::wing> plants{};
    for (std::size_t i = 0; i < seats.count; ++i) {
      plants[i] = &riders[i].plant();
      taken_[seats.places[i]] = true;
    }
    convoy_->board(std::span(seats.places).first(seats.count), std::span(plants).first(seats.count));
    const std::size_t place = seats.places.front();
    at_[place] = seats;
    if (!set_off(place)) leave(place);
    return true;
  }

  void leave(std::size_t place) {
    for (std::size_t i = 0; i < at_[place].count; ++i) taken_[at_[place].places[i]] = false;
  }

  /// False if the party has come to its end.
  bool set_off(std::size_t place) {
    Party& party = *at_[place].party;
    if (!party.go_on()) {
      party.end(convoy_->counters(place));
      return false;
    }
    go(place);
    return true;
  }

  /// As far as what is held goes.
  void go(std::size_t place) {
    const auto riders = at_[place].party->riders();
    std::array<engine::Bound, engine::Convoy::wing> bound{};
    for (std::size_t i = 0; i < riders.size(); ++i) bound[i] = {&riders[i].now.flow, &riders[i].now.held};
    convoy_->set_off(place, std::span(bound).first(riders.size()), riders.front().now.time_s, next_s(riders));
  }

  void come(std::size_t place, bool arrived) {
    Party& party = *at_[place].party;
    if (!arrived) {
      party.alone(convoy_->pace(place), convoy_->counters(place));
    } else {
      const auto riders = party.riders();
      if (!arrive(riders, next_s(riders))) return go(place);
      if (std::ranges::any_of(riders, [](const Rider& rider) { return !rider.now.reads; }))
        party.alone(convoy_->pace(place), convoy_->counters(place));  // which fails there, with its reason
      else if (turned_stiff(place))
        go_on_alone(place, party);
      else if (set_off(place))
        return;
    }
    leave(place);
    fill();
  }

  /// With the method for stiff rigs, as the automatic one does.
  void go_on_alone(std::size_t place, Party& party) {
    if (!party.go_on()) return party.end(convoy_->counters(place));
    engine::Pace pace = convoy_->pace(place);
    pace.stiff_from_tick = pace.ticks;
    party.alone(pace, convoy_->counters(place));
  }

  bool turned_stiff(std::size_t place) {
    Seats& seats = at_[place];
    return may_turn_stiff_ && seats.count == 1 &&
           seats.watch.is_stiff(convoy_->pace(place), convoy_->counters(place));
  }

  const std::function<Party*()>& next_;
  bool may_turn_stiff_;
  std::size_t places_;
  std::unique_ptr<engine::Convoy> convoy_;
  Party* waiting_ = nullptr;  ///< for places to become free
  std::array<Seats, engine::Convoy::places> at_{};
  std::array<bool, engine::Convoy::places> taken_{};
};

}  // namespace

bool StiffWatch::is_stiff(const engine::Pace& pace, const engine::Counters& solver) {
  if (pace.ticks % engine::window_ticks != 0) return false;
  const long cost = solver.right_hand_sides;
  const bool stiff = cost - cost_before_ > engine::stiff_cost_per_tick * engine::window_ticks;
  cost_before_ = cost;
  return stiff;
}

std::optional<ConvoyClass> convoy_class(std::span<const plant::Rig* const> rigs, const Drive& drive,
                                        const solver::Settings& settings, bool keep_ledger) {
  const bool possible = rigs.size() <= engine::Convoy::wing && settings.method != solver::Method::cvode &&
                        std::all_of(rigs.begin(), rigs.end(), [&](const plant::Rig* rig) {
                          return engine::can_join_a_convoy(*rig, keep_ledger);
                        });
  if (!possible) return std::nullopt;
  auto kind = engine::kind_of(rigs);
  if (!kind) return std::nullopt;
  const bool remembers =
      std::any_of(rigs.begin(), rigs.end(), [](const plant::Rig* rig) { return rig->remembers(); });
  return ConvoyClass{remembers,          keep_ledger,   settings.method,
                     settings.tolerance, drive.given(), drive.contraction_ratio.has_value(),
                     *std::move(kind)};
}

void ride_in_convoy(const std::function<Party*()>& next, const ConvoyClass& all, std::size_t places) {
  Carrying(next, all, places)();
}

}  // namespace mckibben::ride
