// See the header.
#include <sim/engine/lane_problem.hpp>

namespace mckibben::engine {

template <bool remembers>
Mask LaneProblem<remembers>::rates(const plant::PlantOf<Lanes>& plant, const plant::HeldOf<Lanes>& held,
                                   N_Vector y, N_Vector dydt, std::size_t block) {
  Mask inside;
  on_this_machine([&] {
    // Each by itself: for a block this long the compiler would take a slow instruction.
    plant::State<Lanes> state;
    state.joint = {at(y, 0, block), at(y, 1, block)};
    state.side = {at(y, 2, block), at(y, 3, block), at(y, 4, block)};
    plant::Memory<Lanes> memory;
    for (std::size_t i = 0; i < memory.side.size(); ++i)
      memory.side[i] = remembers ? at(y, (L::states + i) % L::size, block) : Lanes(0.0);
    inside = plant.template in_domain<1>(state);
    const auto now = plant.template moment<1>(state, memory, held);
    const auto slopes = plant.template rates<1>(state, now);
    at(dydt, 0, block) = slopes.joint.contraction_ratio;
    at(dydt, 1, block) = slopes.joint.contraction_speed_per_s;
    at(dydt, 2, block) = slopes.side.valve_pressure_Pa;
    at(dydt, 3, block) = slopes.side.muscle_pressure_Pa;
    at(dydt, 4, block) = slopes.side.bristle_m;
    if constexpr (remembers)
      for (std::size_t i = 0; i < memory.side.size(); ++i)
        at(dydt, L::states + i, block) = now.memory_rates[i];
  });
  return inside;
}

template struct LaneProblem<false>;
template struct LaneProblem<true>;

}  // namespace mckibben::engine
