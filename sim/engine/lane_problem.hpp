// What a SUNDIALS vector of lanes goes through: the laws of the plant, eight rigs at once.
#pragma once

#include <array>

#include <plant/plant.hpp>
#include <sim/engine/lane_vector.hpp>
#include <sim/engine/problem.hpp>

namespace mckibben::engine {

template <plant::Memories memories, int sides = 1, Books books = Books::none>
struct LaneProblem {
  static_assert(books != Books::polytropic, "rigs whose gas has a temperature keep their ledger alone");
  using L = Layout<sides, memories, books>;
  struct V : LaneVector<L::size, L::steering, L::counted> {
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

  /// Of all lanes of a block, for each of them times `by`; false for those outside the domain of the laws.
  static Mask rates(const plant::PlantOf<Lanes>& plant, const plant::HeldOf<Lanes>& held, const Lanes& by,
                    N_Vector y, N_Vector dydt, std::size_t block = 0);
};

// The laws in lanes are what takes longest to compile: once, in lane_problem.cpp.
extern template struct LaneProblem<plant::Memories::none>;
extern template struct LaneProblem<plant::Memories::few>;
extern template struct LaneProblem<plant::Memories::all>;
extern template struct LaneProblem<plant::Memories::none, 2>;
extern template struct LaneProblem<plant::Memories::few, 2>;
extern template struct LaneProblem<plant::Memories::none, 1, Books::isothermal>;
extern template struct LaneProblem<plant::Memories::few, 1, Books::isothermal>;

}  // namespace mckibben::engine
