// What the plant remembers. What flows in time (State) is kept apart from what jumps at ticks (Held), and
// what belongs to one muscle side from what belongs to the joint. A second muscle that pulls on the same
// wheel is the `opposite` of each; where there is none, nobody looks at it.
#pragma once

#include <algorithm>
#include <array>

#include <plant/effects.hpp>

namespace mckibben::plant {

template <class S>
struct JointState {
  S contraction_ratio;        ///< e, of the muscle; of the first one of a pair
  S contraction_speed_per_s;  ///< w = de/dt
};

template <class S>
struct SideState {
  S valve_pressure_Pa;   ///< P_v, gauge, in the valve's controlled volume
  S muscle_pressure_Pa;  ///< P_m, gauge
  S bristle_m;           ///< z, deflection of the thread bristles
};

template <class S>
struct State {
  JointState<S> joint;
  SideState<S> side, opposite;
};

/// What one side remembers (EffectSet::memories): of a regulator of second order the pressure error [Pa] that
/// it has come to follow; of laws their memories in sizes of their own, and the time [s]; of a cord its
/// stretch [m], and the speed of the muscle's end [m/s]; all zero at the start.
inline constexpr std::size_t regulator_memory = Effects::memories, cord_stretch = Effects::all_memories,
                             cord_end_speed = cord_stretch + 1, all_memories = cord_end_speed + 1;
template <class S>
using SideMemory = std::array<S, all_memories>;
/// Of that what integrators carry: the first so many.
constexpr int carried(Memories used) {
  return static_cast<int>(used == Memories::none  ? 0
                          : used == Memories::few ? Effects::few_memories
                                                  : all_memories);
}
template <class S>
struct Memory {
  SideMemory<S> side, opposite;
};

/// Where air and work went since the start, on both sides: integrals that nothing in the plant depends on.
template <class S>
struct Ledger {
  S air_drawn_kg;            ///< from the supply
  S air_vented_kg;           ///< to the atmosphere, through the valve
  S air_leaked_kg;           ///< to the atmosphere, from the muscle
  S braid_work_J;            ///< done by the braid on the load
  S thread_friction_work_J;  ///< taken by the threads
  S guide_work_J;            ///< taken by the load guide, by bearings, and by cords that stretch
  S stop_work_J;             ///< done by the taut threads on the load
  S effects_work_J;          ///< done by the pull of effects on the load
  S bench_work_J;            ///< done on the cord by what gives the muscle its length, or pulls from outside
  // Only where the gas is polytropic; else pressures and volumes tell what is there.
  S valve_air_kg, muscle_air_kg;  ///< what is there, not a sum
  S air_inflow_J;                 ///< R T of all that came less what went, as the gas law counts it
  S gas_work_J;                   ///< done by the muscles' gas on their walls, atmosphere included
  S gas_heat_J;                   ///< what the temperature of the muscles' gas adds to p V
  S opposite_valve_air_kg, opposite_muscle_air_kg;
};

/// Components of a state with one muscle, with two, and of what else an integrator may carry.
inline constexpr int single_size = 5, pair_size = 8;
/// Working sizes of memories, in their own units.
inline constexpr auto memory_sizes = [] {
  SideMemory<double> sizes{};
  sizes.fill(1.0);
  std::copy(Effects::memory_sizes.begin(), Effects::memory_sizes.end(), sizes.begin());
  sizes[regulator_memory] = 1e5;
  sizes[cord_stretch] = 1e-3;
  sizes[cord_end_speed] = 0.3;
  return sizes;
}();
inline constexpr int ledger_size = 16, isothermal_ledger_size = 9;
static_assert(sizeof(State<double>) == pair_size * sizeof(double));
static_assert(sizeof(Memory<double>) == 2 * sizeof(SideMemory<double>));
static_assert(sizeof(Ledger<double>) == ledger_size * sizeof(double));

/// Share that a ledger leaves unexplained: of the gas that was there or came, of the work done.
struct Imbalance {
  double gas = 0.0, energy = 0.0;
};

/// Motion of a joint with Coulomb friction; `sticking` also means "not Coulomb's business" for LuGre threads.
enum class Slip { sticking, rising, falling };

/// Which pressure of a side is given, if one is. What lies upstream of it does not exist then.
enum class GivenPressure { none, valve, muscle };

/// What is constant on one side between two ticks or events.
template <class P>
struct HeldSideOf {
  P reference_pressure_Pa = 0.0;   ///< P_ref, gauge
  P current_speed_mA_per_s = 0.0;  ///< nu of T 4.6: change of the held current over the last tick
  GivenPressure given = GivenPressure::none;
  P pressure_rate_Pa_per_s = 0.0;  ///< how fast a given pressure runs to its next value
  P supply_above_Pa = 0.0;         ///< of a supply whose pressure is given: by how much it is above the rig's
  P fills = 0.0, vents = 0.0;      ///< of valves that are open or shut: 1 or 0; of a sealed muscle, whether
                                   ///< it is being filled and keeps its pressure, or is shut
};
using HeldSide = HeldSideOf<double>;

template <class P>
struct HeldOf : HeldSideOf<P> {
  Slip slip = Slip::sticking;
  /// The muscle's length is given: w stays what it is, whatever force that takes.
  bool length_is_given = false;
  P joint_force_N = 0.0;  ///< on the cord from outside, beside the load: positive lengthens the first muscle
  HeldSideOf<P> opposite{};
};
using Held = HeldOf<double>;

}  // namespace mckibben::plant
