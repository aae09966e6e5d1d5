// What a SUNDIALS vector of lanes goes through: the laws of the plant, eight rigs at once.
#pragma once

#include <array>

#include <plant/plant.hpp>
#include <sim/engine/lane_vector.hpp>
#include <sim/engine/problem.hpp>

namespace mckibben::engine {

template <bool remembers>
struct LaneProblem {
  using L = Layout<1, remembers, Books::none>;
  struct V : LaneVector<L::size, L::counted> {
    using layout = L;
  };
  using One = std::array<double, L::size>;  ///< what is carried of one rig

  /// Component i of a block of eight.
  static Lanes& at(N_Vector v, std::size_t i, std::size_t block = 0) {
    auto& values = V::values(v);
    return values[i * (values.size() / L::size) + block];
  }
  static void put(const One& one, std::size_t rig, N_Vector all) {
    for (std::size_t i = 0; i < one.size(); ++i)
      at(all, i, rig / Lanes::count).set(rig % Lanes::count, one[i]);
  }
  static One of(std::size_t rig, N_Vector all) {
    One one;
    for (std::size_t i = 0; i < one.size(); ++i) one[i] = at(all, i, rig / Lanes::count)[rig % Lanes::count];
    return one;
  }

  /// Of all lanes of a block; false for those outside the domain of the laws.
  static Mask rates(const plant::PlantOf<Lanes>& plant, const plant::HeldOf<Lanes>& held, N_Vector y,
                    N_Vector dydt, std::size_t block = 0) {
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
};

}  // namespace mckibben::engine
