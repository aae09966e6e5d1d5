// What is known of one side of a joint at an instant: what side.hpp computes and everything else reads.
#pragma once

#include <plant/state.hpp>
#include <plant/valve_flow.hpp>

namespace mckibben::plant {

/// The cord's end of one muscle, as the joint moves it.
template <class S>
struct Stroke {
  S contraction_ratio;  ///< e
  S speed_per_s;        ///< w = de/dt
};

/// Everything known of a side at one instant.
/// Forces in N and positive where they shorten the muscle, flows in kg/s.
template <class S>
struct SideMoment : ValveMoment<S> {
  Stroke<S> stroke;                      // the muscle's own
  S speed_m_per_s;                       // v = l0 w
  S volume_m3, volume_slope_m3;          // V, dV/de
  S braid_force_N, stop_force_N;         // F, F_s
  S friction_level_N, friction_force_N;  // G, F_f
  S bristle_rate_m_per_s;                // dz/dt
  S leak_flow, effects_pull_N;           // what effects take and add
  S pull_on_load_N;                      // of that, beyond the cord
  S heating_Pa_per_s;                    // what the temperature of the muscle's gas adds to dP_m/dt
  SideMemory<S> memory_rates;
  bool stretches;              // its cord; if so:
  S stretched_N, cord_lost_W;  // what that pulls with, and what its damping takes

  /// T, what the cord carries.
  S cord_force_N() const {
    if (stretches) return stretched_N;
    return muscle_force_N();
  }
  /// What the muscle pulls on it with.
  S muscle_force_N() const {
    return braid_force_N + stop_force_N + effects_pull_N + friction_force_N - pull_on_load_N;
  }
};

}  // namespace mckibben::plant
