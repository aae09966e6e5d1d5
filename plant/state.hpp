// What the plant remembers. What flows in time (State) is kept apart from what jumps at ticks (Held), and
// what belongs to one muscle side from what belongs to the joint, because a second muscle may pull on the
// same wheel.
#pragma once

#include <array>

#include <plant/effects.hpp>

namespace mckibben::plant {

template <class S>
struct JointState {
  S contraction_ratio;        ///< e
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
  SideState<S> side;
};

/// What effects with a memory remember, in the order of their table; all zero at the start of a run.
template <class S>
using Memory = std::array<S, Effects::memories>;

/// Where air and work went since the start: integrals that nothing in the plant depends on.
template <class S>
struct Ledger {
  S air_drawn_kg;            ///< from the supply
  S air_vented_kg;           ///< to the atmosphere, through the valve
  S air_leaked_kg;           ///< to the atmosphere, from the muscle
  S braid_work_J;            ///< done by the braid on the load
  S thread_friction_work_J;  ///< taken by the threads
  S guide_work_J;            ///< taken by the load guide
  S stop_work_J;             ///< done by the taut threads on the load
  S effects_work_J;          ///< done by the pull of effects on the load
  // Only where the gas is polytropic; else pressures and volumes tell what is there.
  S valve_air_kg, muscle_air_kg;  ///< what is there, not a sum
  S air_inflow_J;                 ///< R T of all that came less what went, as the gas law counts it
  S gas_work_J;                   ///< done by the muscle's gas on its walls, atmosphere included
};

inline constexpr int state_size = 5, memory_size = Effects::memories;
inline constexpr int ledger_size = 12, isothermal_ledger_size = 8;
static_assert(sizeof(State<double>) == state_size * sizeof(double));
static_assert(sizeof(Ledger<double>) == ledger_size * sizeof(double));

/// Share that a ledger leaves unexplained: of the gas that was there or came, of the work done.
struct Imbalance {
  double gas = 0.0, energy = 0.0;
};

/// Motion of a joint with Coulomb friction; `sticking` also means "not Coulomb's business" for LuGre threads.
enum class Slip { sticking, rising, falling };

/// What is constant between two ticks or events.
struct Held {
  double reference_pressure_Pa = 0.0;   ///< P_ref, gauge
  double current_speed_mA_per_s = 0.0;  ///< nu of T 4.6: change of the held current over the last tick
  Slip slip = Slip::sticking;
};

}  // namespace mckibben::plant
