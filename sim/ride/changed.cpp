// What goes on and what begins; see the header.
#include <tuple>

#include <sim/ride/changed.hpp>
#include <sim/ride/underway.hpp>

namespace mckibben::ride {
namespace {

/// Which effects begin, by their memories; their plays are made new.
Memories begun(const plant::Effects& before, const plant::Effects& now, plant::Effects::Plays& plays) {
  Memories begin{};
  std::size_t place = 0, slot = 0;
  const auto look_at = [&]<class E>(const E& effect) {
    const bool begins = !effect.absent() && before.get<E>().absent();
    if (begins) plays[place] = {};
    ++place;
    if constexpr (plant::Remembers<E>) begin[slot++] = begins;
  };
  std::apply([&](const auto&... effect) { (look_at(effect), ...); }, now.all);
  return begin;
}

}  // namespace

Rider changed(const Rider& rider, const Hanging& other) {
  Rider next(other);
  next.now = rider.now;
  const plant::Effects& before = rider.plant().rig().effects;
  const plant::Effects& now = next.plant().rig().effects;
  Rider::State& state = next.now;
  const Memories begin = begun(before, now, state.plays);
  for (std::size_t slot = 0; slot < begin.size(); ++slot)
    if (begin[slot]) state.flow.memory.side[slot] = 0.0;
  rest_memories(next, next.plant().at_rest(state.held), 0.0, begin);
  if (before.command_delay_s() == 0.0) state.commands.begin(state.drive.current_mA);
  if (before.reading_delay_s() == 0.0) state.rises = {};
  next.open_ledger();
  next.look();
  return next;
}

}  // namespace mckibben::ride
