// What goes on and what begins; see the header.
#include <algorithm>
#include <tuple>

#include <sim/ride/changed.hpp>
#include <sim/ride/underway.hpp>

namespace mckibben::ride {
namespace {

/// Which effects begin, by their memories; their plays are made new.
SomeMemories begun(const plant::Effects& before, const plant::Effects& now, plant::Effects::Plays& plays) {
  SomeMemories begin{};
  std::size_t place = 0, slot = 0;
  const auto look_at = [&]<class E>(const E& effect) {
    const bool begins = !effect.absent() && before.get<E>().absent();
    if (begins) plays[place] = {};
    ++place;
    if constexpr (plant::Remembers<E>) begin[slot++] = begins;
    if constexpr (plant::RemembersMore<E>)
      std::fill_n(begin.begin() + plant::Effects::further_from<E>, E::further_memories, begins);
  };
  std::apply([&](const auto&... effect) { (look_at(effect), ...); }, now.all);
  return begin;
}

/// What goes on and begins on one muscle's side.
void go_on(Rider& next, Muscle muscle, const plant::Effects& before, const plant::Effects& now,
           plant::Effects::Plays& plays, PastCommands& commands, double current_mA) {
  const SomeMemories begin = begun(before, now, plays);
  auto& memory = next.now.flow.memory;
  for (std::size_t slot = 0; slot < begin.size(); ++slot)
    if (begin[slot]) (muscle == Muscle::first ? memory.side : memory.opposite)[slot] = 0.0;
  rest_memories(next, next.plant().at_rest(next.now.held), 0.0, begin, muscle);
  if (before.command_delay_s() == 0.0) commands.begin(current_mA);
}

}  // namespace

Rider changed(const Rider& rider, const Loaded& other) {
  Rider next(other);
  Rider::State& state = next.now = rider.now;
  const plant::Effects& before = rider.plant().rig().effects;
  go_on(next, Muscle::first, before, next.plant().rig().effects, state.plays, state.commands,
        state.drive.current_mA);
  if (next.plant().opposite())
    go_on(next, Muscle::opposite, rider.plant().opposite()->rig().effects,
          next.plant().opposite()->rig().effects, state.opposite_plays, state.opposite_commands,
          state.drive.opposite.current_mA);
  if (before.reading_delay_s() == 0.0 && !rider.plant().rig().sensors.position().is_late()) state.rises = {};
  next.open_ledger();
  next.look();
  return next;
}

}  // namespace mckibben::ride
