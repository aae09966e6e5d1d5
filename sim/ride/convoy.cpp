// Places are taken by the next passenger as they become free; see the header.
#include <array>
#include <memory>

#include <sim/ride/convoy.hpp>

namespace mckibben::ride {
namespace {

class Carrying {
 public:
  Carrying(const std::function<Passenger*()>& next, const solver::Settings& settings, std::size_t places)
      : next_(next),
        may_turn_stiff_(settings.method == solver::Method::automatic),
        settings_(settings),
        places_(places) {}

  void operator()() {
    Passenger* first = next_();
    if (first == nullptr) return;
    convoy_ = engine::make_convoy(first->rider().plant().remembers(), settings_.tolerance);
    board(0, first);
    for (std::size_t place = 1; place < places_; ++place) board(place, next_());
    convoy_->go([this](std::size_t place, bool arrived) { come(place, arrived); });
  }

 private:
  /// The passenger takes the place and sets off; or the next one who does.
  void board(std::size_t place, Passenger* passenger) {
    for (; passenger != nullptr; passenger = next_()) {
      convoy_->board(place, passenger->rider().plant());
      cost_before_[place] = 0;
      if (set_off(place, *passenger)) break;
    }
    at_[place] = passenger;
  }

  bool set_off(std::size_t place, Passenger& passenger) {
    if (!passenger.go_on()) {
      passenger.end(convoy_->counters(place));
      return false;
    }
    Rider::State& now = passenger.rider().now;
    convoy_->set_off(place, {&now.flow, &now.held}, now.time_s, now.until_s);
    return true;
  }

  void come(std::size_t place, bool arrived) {
    Passenger& passenger = *at_[place];
    if (!arrived) {
      passenger.alone(convoy_->pace(place), convoy_->counters(place));
    } else {
      passenger.rider().arrive();
      if (turned_stiff(place))
        go_on_alone(place, passenger);
      else if (set_off(place, passenger))
        return;
    }
    board(place, next_());
  }

  /// With the method for stiff rigs, as the automatic one does.
  void go_on_alone(std::size_t place, Passenger& passenger) {
    if (!passenger.go_on()) return passenger.end(convoy_->counters(place));
    engine::Pace pace = convoy_->pace(place);
    pace.stiff_from_tick = pace.ticks;
    passenger.alone(pace, convoy_->counters(place));
  }

  bool turned_stiff(std::size_t place) {
    if (!may_turn_stiff_ || convoy_->pace(place).ticks % engine::window_ticks != 0) return false;
    const long cost = convoy_->counters(place).right_hand_sides;
    const bool stiff = cost - cost_before_[place] > engine::stiff_cost_per_tick * engine::window_ticks;
    cost_before_[place] = cost;
    return stiff;
  }

  const std::function<Passenger*()>& next_;
  bool may_turn_stiff_;
  solver::Settings settings_;
  std::size_t places_;
  std::unique_ptr<engine::Convoy> convoy_;
  std::array<Passenger*, engine::Convoy::places> at_{};
  std::array<long, engine::Convoy::places> cost_before_{};
};

}  // namespace

bool can_join_a_convoy(const plant::Rig& rig, solver::Method method) {
  return method != solver::Method::cvode && engine::can_join_a_convoy(rig);
}

void ride_in_convoy(const std::function<Passenger*()>& next, const solver::Settings& settings,
                    std::size_t places) {
  Carrying(next, settings, places)();
}

}  // namespace mckibben::ride
