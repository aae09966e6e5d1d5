// See the header.
#include <sim/engine/lane_problem.hpp>

namespace mckibben::engine {
namespace {

plant::Memory<Lanes> blank() {
  plant::Memory<Lanes> memory;
  memory.side.fill(Lanes(0.0));
  memory.opposite.fill(Lanes(0.0));
  return memory;
}
const plant::Memory<Lanes> none_at_all = blank();  // filled once: it is two kilobytes a side

}  // namespace

template <plant::Memories memories, int sides, Books books>
Mask LaneProblem<memories, sides, books>::rates(const plant::PlantOf<Lanes>& plant,
                                                const plant::HeldOf<Lanes>& held, const Lanes& by, N_Vector y,
                                                N_Vector dydt, std::size_t block) {
  Mask inside;
  on_this_machine([&] {
    // Each by itself: for a block this long the compiler would take a slow instruction.
    plant::State<Lanes> state;
    state.joint = {at(y, 0, block), at(y, 1, block)};
    state.side = {at(y, 2, block), at(y, 3, block), at(y, 4, block)};
    if constexpr (sides == 2) state.opposite = {at(y, 5, block), at(y, 6, block), at(y, 7, block)};
    constexpr std::size_t each = L::of_side;
    plant::Memory<Lanes> carried;
    if constexpr (each > 0) {
      carried.side.fill(Lanes(0.0));
      if constexpr (sides == 2) carried.opposite.fill(Lanes(0.0));
    }
    for (std::size_t i = 0; i < each; ++i) {
      carried.side[i] = at(y, L::states + i, block);
      if constexpr (sides == 2) carried.opposite[i] = at(y, L::states + each + i, block);
    }
    const plant::Memory<Lanes>& memory = each > 0 ? carried : none_at_all;
    inside = plant.template in_domain<sides>(state, memory);
    const auto now = plant.template moment<sides>(state, memory, held);
    const auto slopes = plant.template rates<sides>(state, now);
    at(dydt, 0, block) = by * slopes.joint.contraction_ratio;
    at(dydt, 1, block) = by * slopes.joint.contraction_speed_per_s;
    at(dydt, 2, block) = by * slopes.side.valve_pressure_Pa;
    at(dydt, 3, block) = by * slopes.side.muscle_pressure_Pa;
    at(dydt, 4, block) = by * slopes.side.bristle_m;
    if constexpr (sides == 2) {
      at(dydt, 5, block) = by * slopes.opposite.valve_pressure_Pa;
      at(dydt, 6, block) = by * slopes.opposite.muscle_pressure_Pa;
      at(dydt, 7, block) = by * slopes.opposite.bristle_m;
    }
    for (std::size_t i = 0; i < each; ++i) {
      at(dydt, L::states + i, block) = by * now.memory_rates[i];
      if constexpr (sides == 2) at(dydt, L::states + each + i, block) = by * now.opposite.memory_rates[i];
    }
    if constexpr (L::audits) {
      const auto ledger = plant.template ledger_rates<sides>(state, now, plant::Ledger<Lanes>{});
      const std::array entries{ledger.air_drawn_kg, ledger.air_vented_kg,          ledger.air_leaked_kg,
                               ledger.braid_work_J, ledger.thread_friction_work_J, ledger.guide_work_J,
                               ledger.stop_work_J,  ledger.effects_work_J,         ledger.bench_work_J};
      static_assert(entries.size() == L::entries);
      for (std::size_t i = 0; i < entries.size(); ++i) at(dydt, L::steering + i, block) = by * entries[i];
    }
  });
  return inside;
}

template struct LaneProblem<plant::Memories::none>;
template struct LaneProblem<plant::Memories::few>;
template struct LaneProblem<plant::Memories::all>;
template struct LaneProblem<plant::Memories::none, 2>;
template struct LaneProblem<plant::Memories::few, 2>;
template struct LaneProblem<plant::Memories::none, 1, Books::isothermal>;
template struct LaneProblem<plant::Memories::few, 1, Books::isothermal>;

}  // namespace mckibben::engine
